//! Code pages of ISO 8859 that texts may name by `\PA\` to `\PI\`: what each has in place of the characters of the first.

/// The characters 0xA0 to 0xFF of the page with this letter; those of the first page for others.
pub(super) fn page(letter: u8) -> [char; 96] {
    let others = PAGES.get(usize::from(letter.wrapping_sub(b'A'))).copied().unwrap_or_default();
    let mut page = std::array::from_fn(|k| char::from(0xa0 + k as u8));
    for (first, characters) in others {
        let from = usize::from(first - 0xa0);
        for (place, character) in page[from..].iter_mut().zip(characters.chars()) {
            *place = character;
        }
    }
    page
}

/// Of each page the differences from the first: runs of characters, each with the code of its first one.
const PAGES: [&[(u8, &str)]; 9] = [
    &[],
    // ISO 8859-2.
    &[
        (0xa1, "Ą˘Ł"),
        (0xa5, "ĽŚ"),
        (0xa9, "ŠŞŤŹ"),
        (0xae, "ŽŻ"),
        (0xb1, "ą˛ł"),
        (0xb5, "ľśˇ"),
        (0xb9, "šşťź˝žżŔ"),
        (0xc3, "Ă"),
        (0xc5, "ĹĆ"),
        (0xc8, "Č"),
        (0xca, "Ę"),
        (0xcc, "Ě"),
        (0xcf, "ĎĐŃŇ"),
        (0xd5, "Ő"),
        (0xd8, "ŘŮ"),
        (0xdb, "Ű"),
        (0xde, "Ţ"),
        (0xe0, "ŕ"),
        (0xe3, "ă"),
        (0xe5, "ĺć"),
        (0xe8, "č"),
        (0xea, "ę"),
        (0xec, "ě"),
        (0xef, "ďđńň"),
        (0xf5, "ő"),
        (0xf8, "řů"),
        (0xfb, "ű"),
        (0xfe, "ţ˙"),
    ],
    // ISO 8859-3.
    &[
        (0xa1, "Ħ˘"),
        (0xa5, "\u{fffd}Ĥ"),
        (0xa9, "İŞĞĴ"),
        (0xae, "\u{fffd}Ż"),
        (0xb1, "ħ"),
        (0xb6, "ĥ"),
        (0xb9, "ışğĵ"),
        (0xbe, "\u{fffd}ż"),
        (0xc3, "\u{fffd}"),
        (0xc5, "ĊĈ"),
        (0xd0, "\u{fffd}"),
        (0xd5, "Ġ"),
        (0xd8, "Ĝ"),
        (0xdd, "ŬŜ"),
        (0xe3, "\u{fffd}"),
        (0xe5, "ċĉ"),
        (0xf0, "\u{fffd}"),
        (0xf5, "ġ"),
        (0xf8, "ĝ"),
        (0xfd, "ŭŝ˙"),
    ],
    // ISO 8859-4.
    &[
        (0xa1, "ĄĸŖ"),
        (0xa5, "ĨĻ"),
        (0xa9, "ŠĒĢŦ"),
        (0xae, "Ž"),
        (0xb1, "ą˛ŗ"),
        (0xb5, "ĩļˇ"),
        (0xb9, "šēģŧŊžŋĀ"),
        (0xc7, "ĮČ"),
        (0xca, "Ę"),
        (0xcc, "Ė"),
        (0xcf, "ĪĐŅŌĶ"),
        (0xd9, "Ų"),
        (0xdd, "ŨŪ"),
        (0xe0, "ā"),
        (0xe7, "įč"),
        (0xea, "ę"),
        (0xec, "ė"),
        (0xef, "īđņōķ"),
        (0xf9, "ų"),
        (0xfd, "ũū˙"),
    ],
    // ISO 8859-5.
    &[
        (0xa1, "ЁЂЃЄЅІЇЈЉЊЋЌ"),
        (0xae, "ЎЏАБВГДЕЖЗИЙКЛМНОПРСТУФХЦЧШЩЪЫЬЭЮЯабвгдежзийклмнопрстуфхцчшщъыьэюя№ёђѓєѕіїјљњћќ§ўџ"),
    ],
    // ISO 8859-6.
    &[
        (0xa1, "\u{fffd}\u{fffd}\u{fffd}"),
        (0xa5, "\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{60c}"),
        (
            0xae,
            "\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{61b}\u{fffd}\u{fffd}\u{fffd}\u{61f}\u{fffd}\u{621}\u{622}\u{623}\u{624}\u{625}\u{626}\u{627}\u{628}\u{629}\u{62a}\u{62b}\u{62c}\u{62d}\u{62e}\u{62f}\u{630}\u{631}\u{632}\u{633}\u{634}\u{635}\u{636}\u{637}\u{638}\u{639}\u{63a}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{640}\u{641}\u{642}\u{643}\u{644}\u{645}\u{646}\u{647}\u{648}\u{649}\u{64a}\u{64b}\u{64c}\u{64d}\u{64e}\u{64f}\u{650}\u{651}\u{652}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}",
        ),
    ],
    // ISO 8859-7.
    &[
        (0xa1, "‘’"),
        (0xa4, "€₯"),
        (0xaa, "ͺ"),
        (0xae, "\u{fffd}―"),
        (0xb4, "΄΅Ά"),
        (0xb8, "ΈΉΊ"),
        (0xbc, "Ό"),
        (0xbe, "ΎΏΐΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡ\u{fffd}ΣΤΥΦΧΨΩΪΫάέήίΰαβγδεζηθικλμνξοπρςστυφχψωϊϋόύώ\u{fffd}"),
    ],
    // ISO 8859-8.
    &[
        (0xa1, "\u{fffd}"),
        (0xaa, "×"),
        (0xba, "÷"),
        (
            0xbf,
            "\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}‗\u{5d0}\u{5d1}\u{5d2}\u{5d3}\u{5d4}\u{5d5}\u{5d6}\u{5d7}\u{5d8}\u{5d9}\u{5da}\u{5db}\u{5dc}\u{5dd}\u{5de}\u{5df}\u{5e0}\u{5e1}\u{5e2}\u{5e3}\u{5e4}\u{5e5}\u{5e6}\u{5e7}\u{5e8}\u{5e9}\u{5ea}\u{fffd}\u{fffd}\u{200e}\u{200f}\u{fffd}",
        ),
    ],
    // ISO 8859-9.
    &[(0xd0, "Ğ"), (0xdd, "İŞ"), (0xf0, "ğ"), (0xfd, "ış")],
];
