//! PCD: the same points in every storage, in any order of fields, with and without invalid ones.

use super::*;
use crate::error::Located;
use crate::feed::Feed;

fn parsed(bytes: &[u8]) -> std::result::Result<(Parsed, Vec<Point>, Vec<String>), Located> {
    let source = Source { feed: Feed::memory(bytes.to_vec()), bytes: bytes.len() as u64, gzip: false };
    let mut parsed = read(source, &ReadOptions { block: 3, ..ReadOptions::default() })?;
    let crate::format::Content::Points(points) = &mut parsed.content else { panic!("no points") };
    let (mut all, mut block) = (vec![], vec![]);
    loop {
        points.next_block(&mut block)?;
        if block.is_empty() {
            break;
        }
        all.append(&mut block);
    }
    let remarks = points.remarks();
    Ok((parsed, all, remarks))
}

fn header(fields: &str, sizes: &str, types: &str, counts: &str, points: usize, data: &str) -> Vec<u8> {
    format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {fields}\nSIZE {sizes}\nTYPE {types}\n\
         COUNT {counts}\nWIDTH {points}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {points}\nDATA {data}\n"
    )
    .into_bytes()
}

/// Points that single precision holds, every fourth of them without a place.
fn made() -> Vec<Option<[f32; 3]>> {
    (0..20).map(|i| (i % 4 != 2).then_some([i as f32 * 0.25, -1.5 - i as f32, 1e-3 * i as f32])).collect()
}

fn wanted() -> Vec<Point> {
    made().into_iter().flatten().map(|p| p.map(f64::from)).collect()
}

/// A word of literals alone is LZF too.
fn literal(bytes: &[u8]) -> Vec<u8> {
    let runs = bytes.chunks(32).flat_map(|run| [&[run.len() as u8 - 1], run].concat());
    runs.collect()
}

#[test]
fn every_storage_gives_the_same_points() {
    let places: Vec<[f32; 3]> = made().into_iter().map(|p| p.unwrap_or([f32::NAN, 0.0, 1.0])).collect();
    let mut text = header("y rgb z x", "4 1 8 4", "F U F F", "1 3 1 1", places.len(), "ascii");
    let mut rows = header("y rgb z x", "4 1 8 4", "F U F F", "1 3 1 1", places.len(), "binary");
    let mut columns: [Vec<u8>; 4] = Default::default();
    for [x, y, z] in &places {
        text.extend(format!("{y} 1 2 3 {} {x}\r\n", f64::from(*z)).into_bytes());
        let fields = [
            y.to_le_bytes().to_vec(),
            vec![1, 2, 3],
            f64::from(*z).to_le_bytes().to_vec(),
            x.to_le_bytes().to_vec(),
        ];
        rows.extend(fields.concat());
        columns.iter_mut().zip(&fields).for_each(|(column, field)| column.extend(field));
    }
    let whole = columns.concat();
    let packed = literal(&whole);
    let mut compressed =
        header("y rgb z x", "4 1 8 4", "F U F F", "1 3 1 1", places.len(), "binary_compressed");
    compressed.extend((packed.len() as u32).to_le_bytes());
    compressed.extend((whole.len() as u32).to_le_bytes());
    compressed.extend(&packed);
    for bytes in [text, rows, compressed] {
        assert!(is_pcd(&bytes));
        let (parsed, points, remarks) = parsed(&bytes).unwrap();
        assert_eq!(points, wanted(), "{}", parsed.variant);
        assert_eq!(remarks, ["5 point(s) with a coordinate that is not finite left out"]);
        let names = vec!["rgb".to_string()];
        assert_eq!(parsed.warnings, [Warning::Scan(ScanWarning::ColumnsUnread { names })]);
        // A row less, or half of one, is too few.
        let cut = self::parsed(&bytes[..bytes.len() - 30]).map(|_| ()).unwrap_err().fault.to_string();
        assert!(cut.contains("cut short") || cut.contains("6 numbers"), "{cut}");
    }
}

#[test]
fn integers_of_every_size_are_coordinates() {
    for (kind, size, bytes) in [("I", 1, vec![-3i8 as u8]), ("I", 8, (-3i64).to_le_bytes().to_vec())] {
        let mut file =
            header("x y z", &format!("{size} {size} {size}"), &[kind; 3].join(" "), "1 1 1", 1, "binary");
        (0..3).for_each(|_| file.extend(&bytes));
        assert_eq!(parsed(&file).unwrap().1, [[-3.0; 3]]);
    }
}

#[test]
fn headers_that_contradict_themselves_are_refused() {
    let text = String::from_utf8(header("x y z", "4 4 4", "F F F", "1 1 1", 2, "ascii")).unwrap()
        + "1.25 2.25 3.25\n4.25 5.25 6.25\n";
    assert_eq!(parsed(text.as_bytes()).unwrap().1.len(), 2);
    for (from, to, part) in [
        ("WIDTH 2", "WIDTH 3", "WIDTH 3 times HEIGHT 1"),
        ("HEIGHT 1", "HEIGHT 9223372036854775808", "HEIGHT 9223372036854775808"),
        ("FIELDS x y z", "FIELDS x y i", "no x, y and z"),
        ("FIELDS x y z", "FIELDS x y", "FIELDS names 2"),
        ("SIZE 4 4 4", "SIZE 4 4 3", "SIZE 3"),
        ("COUNT 1 1 1", "COUNT 1 1 9999999", "SIZE and COUNT"),
        ("DATA ascii", "DATA asci", "binary_compressed"),
        ("VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0 0 0 1 0 0", "seven numbers"),
        ("4.25 5.25 6.25", "4.25 5.25", "3 numbers"),
        ("4.25 5.25 6.25", "4.25,5.25,6.25", "decimal point"),
        ("4.25 5.25 6.25\n", "", "cut short"),
    ] {
        let changed = text.replace(from, to);
        assert_ne!(changed, text);
        let said = parsed(changed.as_bytes()).map(|_| ()).unwrap_err().fault.to_string();
        assert!(said.contains(part), "{to}: {said}");
    }
}

#[test]
fn a_viewpoint_is_told_and_not_applied() {
    let bytes = header("x y z", "4 4 4", "F F F", "1 1 1", 1, "ascii");
    let text =
        String::from_utf8(bytes).unwrap().replace("VIEWPOINT 0 0 0 1", "VIEWPOINT 5 0 0 1") + "1 2 3\n";
    let (parsed, points, _) = parsed(text.as_bytes()).unwrap();
    assert_eq!(points, [[1.0, 2.0, 3.0]]);
    let viewpoint = "5 0 0 1 0 0 0".to_string();
    assert_eq!(parsed.warnings, [Warning::Scan(ScanWarning::ViewpointUnused { viewpoint })]);
}
