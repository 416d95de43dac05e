//! Signs of characteristics as on drawings (ISO 1101:2017, table 3), drawn as paths: few fonts have them.

use super::super::values::{Name, leaf};
use maud::{Markup, Render, html};
use trueness_document::plan::MaterialWord;

/// The sign of a kind of characteristic in a square of 16; none for what has no sign.
pub fn path(kind: &str) -> Option<&'static str> {
    Some(match kind {
        "straightness" => "M1 8h14",
        "flatness" => "M1 13 5 3h10l-4 10z",
        "roundness" => "M14 8a6 6 0 1 1-12 0 6 6 0 0 1 12 0",
        "cylindricity" => "M12 8a4 4 0 1 1-8 0 4 4 0 0 1 8 0M1 14 5.5 2M10.5 14 15 2",
        "line-profile" => "M1.5 12a6.5 6.5 0 0 1 13 0",
        "surface-profile" => "M1.5 12h13a6.5 6.5 0 0 0-13 0z",
        "parallelism" => "M2.5 14 7.5 2M8.5 14l5-12",
        "perpendicularity" => "M1 14h14M8 14V2",
        "angularity" => "M15 13.5H1.5L13 3",
        "position" => "M12.5 8a4.5 4.5 0 1 1-9 0 4.5 4.5 0 0 1 9 0M8 0.5v15M0.5 8h15",
        "coaxiality" => "M14.5 8a6.5 6.5 0 1 1-13 0 6.5 6.5 0 0 1 13 0M11 8a3 3 0 1 1-6 0 3 3 0 0 1 6 0",
        "symmetry" => "M1 8h14M4 3.5h8M4 12.5h8",
        "circular-runout" => "M3 14 13 3M7.5 3.5 13 3l-.5 5.5",
        "total-runout" => "M2.5 13.5h7M2.5 13.5 7 4M4 6l3-2 .8 3.5M9.5 13.5 14 4M11 6l3-2 .8 3.5",
        _ => return None,
    })
}

/// The sign of a kind, if it has one; its name is to stand beside it.
pub fn symbol(kind: &str) -> Markup {
    html! {
        @if let Some(path) = path(kind) {
            svg.gdt viewBox="0 0 16 16" aria-hidden="true" { (leaf("path", &[("d", &path)])) } " "
        }
    }
}

/// The letter of a material requirement in its circle (ISO 2692): few fonts have Ⓜ and Ⓛ.
pub fn requirement(letter: &str) -> Markup {
    html! { span.circled { (letter) } }
}

/// A datum as results name it (`A`, `A-B`, `A(M)`), its material requirement as a sign.
pub fn datum_name(datum: &str) -> Markup {
    let end = |word: MaterialWord| Some((datum.strip_suffix(&format!("({})", word.word()))?, word));
    match [MaterialWord::M, MaterialWord::L].into_iter().find_map(end) {
        Some((name, word)) => html! { (Name(name)) "\u{a0}" (requirement(word.word())) },
        None => Name(datum).render(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_measure::characteristic::ALL;

    #[test]
    fn every_kind_has_its_words() {
        for kind in ALL {
            let key = format!("\nkind.{}\t", kind.word());
            assert!(trueness_viewer::TEXTS.contains(&key), "{}", kind.word());
        }
    }

    #[test]
    fn every_sign_of_a_drawing_can_be_drawn() {
        for kind in ALL {
            assert_eq!(path(kind.word()).is_some(), !kind.symbol().is_empty(), "{}", kind.word());
        }
    }
}
