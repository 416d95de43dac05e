//! PTX: several scans, their matrices, records without a return.

use super::*;
use crate::feed::Feed;

const SCANNER_LINES: &str = "1 2 3\n1 0 0\n0 1 0\n0 0 1\n";
const QUARTER_TURN: &str = "0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n";
const IDENTITY_LINES: &str = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

fn points(text: &str) -> std::result::Result<(Vec<Point>, Vec<String>), Located> {
    let feed = Feed::memory(text.as_bytes().to_vec());
    let mut parsed = read(Source { feed, bytes: 0, gzip: false }, &ReadOptions::default())?;
    assert_eq!(parsed.unit, Some(Unit::Meter));
    let crate::format::Content::Points(points) = &mut parsed.content else { panic!("no points") };
    let (mut all, mut block) = (vec![], vec![]);
    loop {
        points.next_block(&mut block)?;
        if block.is_empty() {
            return Ok((all, points.remarks()));
        }
        all.append(&mut block);
    }
}

#[test]
fn each_scan_is_moved_by_its_own_matrix() {
    let first = format!("2\n2\n{SCANNER_LINES}{QUARTER_TURN}1 2 3 0.5\n0 0 0 0.5\n0 0 1 0\n0 0 0 0 9 9 9\n");
    let second = format!("1\n2\n{SCANNER_LINES}{IDENTITY_LINES}1 2 3 0.5 1 2 3\n4 5 6 0.5 1 2 3");
    let empty = format!("1\n1\n{SCANNER_LINES}{IDENTITY_LINES}0 0 0 0\n");
    assert!(is_ptx(first.as_bytes()));
    let turned = [[8.0, 21.0, 33.0], [10.0, 20.0, 31.0]];
    let still = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
    for text in [format!("{first}{empty}{second}"), format!("{first}{empty}{second}").replace('\n', "\r\n")] {
        let (all, remarks) = points(&text).unwrap();
        assert_eq!(all, [turned, still].concat());
        assert_eq!(
            remarks,
            ["3 scans read as one cloud, 1 of them empty", "3 record(s) without a return left out"]
        );
    }
}

#[test]
fn scans_that_break_their_word_are_refused_with_the_line() {
    let sound = format!("2\n1\n{SCANNER_LINES}{IDENTITY_LINES}1 2 3 0.5\n4 5 6 0.5\n");
    assert_eq!(points(&sound).unwrap().0.len(), 2);
    for (from, to, line, part) in [
        ("2\n1\n", "3\n1\n", 13, "3 points of a scan declared, 2 present"),
        ("2\n1\n", "1000000000\n1000000000\n", 1, "columns and rows"),
        ("2\n1\n", "1000000\n1000000\n", 1, "1000000000000 points declared"),
        ("2\n1\n", "1.5\n1\n", 1, "columns and rows"),
        ("4 5 6 0.5", "4 5", 12, "three or more numbers"),
        ("4 5 6", "4 5 x", 12, "three or more numbers"),
        ("4 5 6", "4 5 1e999", 12, "finite"),
        ("0 0 0 1\n1", "0 0 0 2\n1", 10, "last column"),
        ("0 1 0\n", "0 1\n", 5, "line 5 of the head"),
    ] {
        let changed = sound.replacen(from, to, 1);
        assert_ne!(changed, sound);
        let fault = points(&changed).map(|_| ()).unwrap_err();
        assert!(fault.fault.to_string().contains(part), "{to}: {}", fault.fault);
        assert_eq!(fault.place, crate::Place::Line(line), "{to}: {}", fault.fault);
    }
}
