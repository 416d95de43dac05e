//! Entities that are not seen are no outline, and a warning names them, as it does entities on several layers.

use super::tests::{place, read};

/// A drawing of layers, blocks and entities.
fn drawing(layers: &str, blocks: &str, entities: &str) -> String {
    let lines = |text: &str| text.split_whitespace().map(|w| format!("{w}\n")).collect::<String>();
    let section = |name: &str, text: &str| format!("0\nSECTION\n2\n{name}\n{}0\nENDSEC\n", lines(text));
    let tables = format!("0 TABLE 2 LAYER 70 9 {layers} 0 ENDTAB");
    format!(
        "{}{}{}0\nEOF\n",
        section("TABLES", &tables),
        section("BLOCKS", blocks),
        section("ENTITIES", entities)
    )
}

/// A line whose places say which it is.
fn line(layer: &str, more: &str, x: u64) -> String {
    format!("0 LINE 8 {layer} {more} 10 {x} 20 0 11 {x} 21 1 ")
}

const LAYERS: &str = "0 LAYER 2 0 70 0 62 7 0 LAYER 2 on 70 0 62 7 0 LAYER 2 off 70 0 62 -7 0 LAYER 2 frozen 70 1 62 7 0 LAYER 2 locked 70 4 62 3";

#[test]
fn entities_that_are_not_seen_are_left_out_and_counted() {
    // The content of the drawing, how many lines are read from it, and the warning.
    let cases: &[(&str, usize, &str)] = &[
        ("0 LINE 8 on 10 0 20 0 11 1 21 0", 1, ""),
        ("0 LINE 8 on 60 0 10 0 20 0 11 1 21 0", 1, ""),
        (
            "0 LINE 8 on 60 1 10 0 20 0 11 1 21 0",
            0,
            "1 entities that are not seen in the drawing were left out: 1 marked",
        ),
        (
            "0 LINE 8 off 10 0 20 0 11 1 21 0 0 LINE 8 OFF 10 0 20 1 11 1 21 1",
            0,
            "2 on layers that are frozen or switched off (OFF, off)",
        ),
        ("0 CIRCLE 8 frozen 10 0 20 0 40 1 0 LINE 8 locked 10 0 20 0 11 1 21 0", 1, "1 on layers"),
        ("0 POLYLINE 8 frozen 70 0 0 VERTEX 10 0 20 0 0 VERTEX 10 1 20 0 0 SEQEND", 0, "1 on layers"),
        ("0 LWPOLYLINE 8 on 60 1 90 2 70 0 10 0 20 0 10 1 20 0", 0, "1 marked"),
        ("0 TEXT 8 frozen 1 t 0 LINE 8 on 10 0 20 0 11 1 21 0", 1, "1 on layers"),
        // Entities that are not seen may be anything.
        ("0 LINE 8 frozen 10 0 20 0 30 0 11 1 21 0 31 9 0 LINE 8 on 10 0 20 0 11 1 21 0", 1, "1 on layers"),
        // The block holds a line on layer 0 and one on its own: a frozen place hides both, one that is off only the first.
        ("0 INSERT 8 on 2 B 10 0 20 0", 2, "on (1), own (1)"),
        ("0 INSERT 8 off 2 B 10 0 20 0", 1, "1 on layers that are frozen or switched off (off)"),
        ("0 INSERT 8 frozen 2 B 10 0 20 0", 0, "1 on layers that are frozen or switched off (frozen)"),
        ("0 INSERT 8 on 60 1 2 B 10 0 20 0", 0, "1 marked"),
    ];
    let block =
        "0 BLOCK 2 B 10 0 20 0 0 LINE 8 0 10 0 20 0 11 1 21 0 0 LINE 8 own 10 0 20 1 11 1 21 1 0 ENDBLK";
    for (entities, count, told) in cases {
        let (found, _, warnings) = read(&drawing(LAYERS, block, entities)).unwrap();
        assert_eq!(found.entities.len(), *count, "{entities} {warnings:?}");
        let all = warnings.join("\n");
        assert!(all.contains(told), "{entities}: {all}");
        assert!(!told.is_empty() || warnings.is_empty(), "{entities}: {all}");
    }
}

#[test]
fn several_layers_are_told() {
    let layers = |names: &[&str]| -> Vec<String> {
        let entities: String = (0..).zip(names).map(|(x, layer)| line(layer, "", x)).collect();
        read(&drawing("", "", &entities)).unwrap().2
    };
    assert!(layers(&["0", "0"]).is_empty());
    assert!(layers(&["section-1", "section-2"]).is_empty());
    let told = layers(&["0", "0", "CENTER"]);
    assert!(
        told.len() == 1 && told[0].contains("0 (2), CENTER (1)") && told[0].contains("switch off"),
        "{told:?}"
    );
}

/// Random drawings against the rule, entity by entity.
#[test]
fn random_drawings_show_what_is_seen() {
    let mut state = 3u64;
    let mut below = |n: u64| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) % n
    };
    let names = ["0", "a", "b", "c"];
    let mut wrong = 0;
    for _ in 0..150 {
        // 0: seen, 1: off, 2: frozen.
        let states = [0, below(3), below(3), below(3)];
        let layers: String = (0..4)
            .map(|i| {
                format!(
                    "0 LAYER 2 {} 70 {} 62 {} ",
                    names[i].to_uppercase(),
                    [0, 4, 1][states[i] as usize],
                    [7, -7, 7][states[i] as usize]
                )
            })
            .collect();
        let (mut entities, mut blocks, mut wanted, mut hidden) = (String::new(), String::new(), vec![], 0);
        for x in 0..below(12) {
            let (layer, marked) = (below(4) as usize, below(5) == 0);
            entities += &line(names[layer], if marked { "60 1" } else { "60 0" }, x);
            if marked || states[layer] > 0 { hidden += 1 } else { wanted.push(x) }
        }
        for block in 1..=below(4) {
            let (outer, mut held) = (below(4) as usize, String::new());
            let frozen = states[outer] == 2;
            for x in 100 * block..100 * block + 1 + below(4) {
                let own = below(4) as usize;
                held += &line(names[own], "", x);
                let layer = if own == 0 { outer } else { own };
                if frozen {
                } else if states[layer] > 0 {
                    hidden += 1;
                } else {
                    wanted.push(x);
                }
            }
            hidden += u64::from(frozen);
            blocks += &format!("0 BLOCK 2 B{block} 10 0 20 0 {held} 0 ENDBLK ");
            entities += &format!("0 INSERT 8 {} 2 b{block} 10 0 20 0 ", names[outer]);
        }
        let (found, _, warnings) = read(&drawing(&layers, &blocks, &entities)).unwrap();
        let read: Vec<u64> = found.entities.iter().map(|e| place(&e.drawn, 0.0)[0] as u64).collect();
        let told = warnings.iter().any(|w| w.starts_with(&format!("{hidden} entities that are not seen")));
        if read != wanted || (hidden > 0) != told {
            wrong += 1;
        }
    }
    assert_eq!(wrong, 0);
}
