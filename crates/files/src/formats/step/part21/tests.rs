//! What is parsed, what is damaged, and how much time and memory it takes.

use super::text::decoded;
use super::{File, Value, parse};
use trueness_geom::progress::Silent;

fn whole(entities: &str) -> String {
    format!(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('it''s; #1=A /*'),'2;1');\nENDSEC;\nDATA;\n{entities}\nENDSEC;\nEND-ISO-10303-21;\n"
    )
}

fn parsed(text: &[u8]) -> File<'_> {
    parse(text, &Silent).unwrap_or_else(|_| unreachable!("nothing stops it"))
}

#[test]
fn values_of_every_kind() {
    let text = whole(
        "#7 = a_B ( $,*,.t.,'it''s',(1,-2.5E1,.5),LENGTH_MEASURE(3.),\"0FA\",#4 , () ) ; /* #8=X(); */\n#4=(A()B(#7,(#4)));",
    );
    let file = parsed(text.as_bytes());
    assert!(file.is_whole() && file.broken().is_empty() && file.count() == 2);
    let entity = file.entity(7).unwrap();
    let record = entity.main(&[]);
    assert_eq!((record.keyword, record.values.len()), ("A_B", 9));
    assert!(record.is_absent(0) && record.is_absent(1) && record.is_absent(6));
    assert_eq!((record.truth(2), record.text(3)), (Ok(true), "it's".into()));
    let numbers: Vec<_> = record.list(4).unwrap().iter().map(|v| record.number(*v)).collect();
    assert_eq!(numbers, [Some(1.0), Some(-25.0), Some(0.5)]);
    assert_eq!((record.real(5), record.entity(7), record.list(8)), (Ok(3.0), Ok(4), Ok(&[][..])));
    let complex = file.entity(4).unwrap();
    assert!(!complex.is_simple() && complex.record("B").unwrap().values[0] == Value::Reference(7));
    let said = record.real(3).unwrap_err().to_string();
    assert_eq!(said, "#7 (line 6) has no finite number as parameter 4 of A_B");
}

/// The damaged entity, why, and those that are read all the same.
#[test]
fn damage_stays_where_it_is() {
    let cases = [
        ("#1=A(1);\n#2=B('never ends,(#1));\n#3=C('x');", 2, "without a quote", 2),
        ("#1=A(1);#2=B('never ends);#3=C('x');#4=D();", 2, "neither comma nor", 2),
        ("#1=A(1);\n#2=B((1,2);\n#3=C();", 2, "neither comma nor", 2),
        ("#1=A(1);\n#2=B(1)\n#3=C();", 2, "semicolon", 2),
        ("#1=A(1);\n#2=B(NaN);\n#3=C();", 2, "word without brackets", 2),
        ("#1=A(1);\n#2=B(1..2);\n#3=C();", 2, "no value", 2),
        ("#1=A(1);\n#2=B(.T);\n#3=C();", 2, "does not end with a point", 2),
        ("#1=A(1);\n#2=<http://elsewhere>;\n#3=C();", 2, "no keyword", 2),
        ("#1=A(1);\n#1=A(1);\n#2=A(1);\n#2=B(1);", 2, "more than once", 1),
        ("#1=A(1);\n#99999999999999999999=B();\n#3=C();", u64::MAX, "64 bits", 2),
        ("#1=A(1);\n#2=B(/* no end\n#3=C();", 2, "no value", 2),
    ];
    for (text, number, reason, others) in cases {
        let text = whole(text);
        let file = parsed(text.as_bytes());
        assert!(file.is_whole(), "{text}");
        let broken: Vec<_> = file.broken().iter().map(|b| (b.number, b.reason)).collect();
        assert_eq!(broken.len(), 1, "{text}: {broken:?}");
        assert!(broken[0].0 == number && broken[0].1.contains(reason), "{text}: {broken:?}");
        assert_eq!(file.count(), others, "{text}");
        assert!(file.entity(number).is_err_and(|e| e.reason == broken[0].1));
    }
    let text = whole("#1=A(\0\u{1}\u{ff});\n#2=B('\0');");
    assert_eq!(parsed(text.as_bytes()).count(), 1);
    let cut = text.split_at(text.len() - 30).0;
    assert!(!parsed(cut.as_bytes()).is_whole());
}

/// Brackets, texts, comments and entities that go on for ever take time in proportion to the text.
#[test]
fn hostile_texts_take_little_time() {
    let times = 200_000;
    let patterns =
        ["(", "A(", "'\n#1='", "/*", "#1=", "\n#1=/*", "'", "#1=A('\n", "#", "\n#1=A((", ";#11111", "=\n \n"];
    for pattern in patterns {
        let text = whole(&format!("#1=B({}\n#3=C();", pattern.repeat(times)));
        let start = std::time::Instant::now();
        let file = parsed(text.as_bytes());
        assert!(file.entity(1).is_err(), "{pattern:?}");
        assert!(start.elapsed().as_secs() < 5, "{pattern:?} took {:?}", start.elapsed());
    }
}

#[test]
fn texts_have_the_characters_that_are_meant() {
    let cases: [(&[u8], &str); 14] = [
        (b"plain", "plain"),
        (b"it''s", "it's"),
        (b"a\\\\b", "a\\b"),
        (b"\\X2\\03A6\\X0\\10", "\u{3a6}10"),
        (b"\\X2\\00C400D6\\X0\\", "\u{c4}\u{d6}"),
        (b"\\X2\\D83DDE00\\X0\\", "\u{1f600}"),
        (b"\\X4\\0001F600\\X0\\x", "\u{1f600}x"),
        (b"\\X\\C4", "\u{c4}"),
        (b"\\S\\D", "\u{c4}"),
        (b"\\PE\\\\S\\0", "\u{410}"),
        (b"\\PG\\\\S\\a", "\u{3b1}"),
        ("\u{c4}\u{20ac}".as_bytes(), "\u{c4}\u{20ac}"),
        (b"\xc4x", "\u{c4}x"),
        (b"\\X2\\12", "12"),
    ];
    for (raw, meant) in cases {
        assert_eq!(decoded(raw), meant);
    }
    assert!(decoded(&b"x".repeat(1 << 20)).len() < 1 << 10);
}
