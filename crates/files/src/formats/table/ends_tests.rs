//! Lines behind the last row, and numbers that nothing parts.

use super::*;
use crate::{error::Located, feed::Feed};
use trueness_geom::space::Point;

pub(super) fn read(text: &[u8]) -> std::result::Result<Vec<Point>, String> {
    let said = |e: Located| e.in_file("f").to_string();
    let source = Source { feed: Feed::memory(text.to_vec()), bytes: 0, gzip: false };
    let parsed = super::read(source, &ReadOptions::default()).map_err(said)?;
    let crate::format::Content::Points(mut stream) = parsed.content else { panic!("a mesh") };
    let (mut points, mut block) = (vec![], vec![]);
    loop {
        stream.next_block(&mut block).map_err(said)?;
        if block.is_empty() {
            return Ok(points);
        }
        points.append(&mut block);
    }
}

const ROWS: &str = "4.5 10.25 6.5\n-6.5 7.25 5.75\n-5.25 8.5 7.125\n5.75 2.5 11.75\n";

#[test]
fn marks_of_the_end_are_no_rows() {
    let want = read(ROWS.as_bytes()).unwrap();
    assert_eq!(want.len(), 4);
    let ends: [&[u8]; 12] = [
        b"\x1a",
        b"\x1a\x1a\x1a",
        b"\r\n\x1a\r\n",
        b"END\n",
        b"end",
        b" EOF \n\n",
        b"END OF FILE\n",
        b"[END]\n",
        b"END.\n",
        b"Ende\n",
        b"FIN\n\x1a",
        b"end of data\n",
    ];
    for end in ends {
        for rows in [ROWS, ROWS.trim_end()] {
            let text = [rows.as_bytes(), end].concat();
            // A word on the line of the last row is one of its cells, or a part of one, and no mark: a fault.
            if rows.ends_with('5') && !matches!(end[0], 0x1a | b'\r') {
                assert!(read(&text).is_err(), "{:?}", String::from_utf8_lossy(end));
                continue;
            }
            assert_eq!(read(&text).as_ref(), Ok(&want), "{:?}", String::from_utf8_lossy(end));
        }
        // As much text as is read in several parts.
        let long = [ROWS.repeat(20_000).as_bytes(), end].concat();
        assert_eq!(read(&long).unwrap().len(), 80_000);
    }
    // Rows behind them are not lost, and other words are told.
    for wrong in ["END\n1.5 2.5 3.5\n", "Total\n", "4 points\n", "\x1a\n1.5 2.5 3.5\n"] {
        assert!(read((ROWS.to_owned() + wrong).as_bytes()).is_err(), "{wrong}");
    }
}

#[test]
fn numbers_that_nothing_parts_are_named() {
    for (text, want) in [
        (ROWS.replace(' ', "\u{a0} "), "no-break spaces"),
        (ROWS.replace(' ', "\u{a0}"), "no-break spaces"),
        (ROWS.replace(' ', "\u{202f}"), "no-break spaces"),
        (" 20.5888784.5375-619.7395\n910.9327-382.0553-155.6771\n".repeat(4), "fixed width"),
        ("953.6021-264.2271144.3158\n409.1403  0.7690-912.4712\n".repeat(4), "fixed width"),
        ("409.1403  0.7690 12.4712\n".repeat(4) + "-878.9325471.6376 70.9621\n", "fixed width"),
        ("409.1403  0.7690 12.4712\n".repeat(4) + "1.234.567 0.5 70.9621\n", "thousands"),
        ("409.1403  0.7690 12.4712\n".repeat(4) + "22.11.2026 0.5 70.9621\n", "thousands"),
    ] {
        let said = read(text.as_bytes()).unwrap_err();
        assert!(said.contains(want), "{said}");
    }
    // In an older code.
    let latin: Vec<u8> =
        ROWS.bytes().flat_map(|b| if b == b' ' { vec![0xa0, b' '] } else { vec![b] }).collect();
    assert!(read(&latin).unwrap_err().contains("no-break spaces"));
}
