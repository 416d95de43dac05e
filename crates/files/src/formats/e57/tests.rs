//! E57: scans written here bit by bit, with poses, states, constants, several packets; and what is wrong in a file.

use super::*;
use crate::error::Located;
use crate::feed::Feed;

/// A column: its element without the name, and a number in bits for each record.
struct Made {
    name: &'static str,
    element: &'static str,
    bits: usize,
    values: Vec<u64>,
}

fn doubles(name: &'static str, values: impl Iterator<Item = f64>) -> Made {
    Made { name, element: "type=\"Float\"", bits: 64, values: values.map(f64::to_bits).collect() }
}

fn singles(name: &'static str, values: impl Iterator<Item = f32>) -> Made {
    let values = values.map(|x| u64::from(x.to_bits())).collect();
    Made { name, element: "type=\"Float\" precision=\"single\"", bits: 32, values }
}

fn packed(column: &Made) -> Vec<u8> {
    let mut bytes = vec![0u8; (column.values.len() * column.bits).div_ceil(8)];
    for (i, value) in column.values.iter().enumerate() {
        for b in 0..column.bits {
            let at = i * column.bits + b;
            bytes[at / 8] |= ((value >> b & 1) as u8) << (at % 8);
        }
    }
    bytes
}

/// Content bytes to a file: pages with their checksums, and the length in the head.
fn paged(mut content: Vec<u8>) -> Vec<u8> {
    content.resize(content.len().next_multiple_of(1020), 0);
    let length = (content.len() / 1020 * 1024) as u64;
    content[16..24].copy_from_slice(&length.to_le_bytes());
    content.chunks(1020).flat_map(|page| [page, &pages::crc32c(page).to_be_bytes()].concat()).collect()
}

/// The offset in the file of a content byte.
fn offset(at: usize) -> u64 {
    (at / 1020 * 1024 + at % 1020) as u64
}

/// A file of scans: their columns and further elements, with packets that hold `packet` bytes of each column.
fn file(scans: &[(Vec<Made>, &str)], packet: usize, more: &str) -> Vec<u8> {
    let mut content = [b"ASTM-E57".to_vec(), vec![1, 0, 0, 0, 0, 0, 0, 0], vec![0; 32]].concat();
    content[40..48].copy_from_slice(&1024u64.to_le_bytes());
    let mut xml = String::from("<?xml version=\"1.0\"?><e57Root type=\"Structure\"><data3D type=\"Vector\">");
    for (columns, pose) in scans {
        let start = content.len();
        content.extend([0; 32]);
        content[start] = 1;
        let first = offset(content.len());
        content[start + 16..start + 24].copy_from_slice(&first.to_le_bytes());
        let streams: Vec<Vec<u8>> = columns.iter().map(packed).collect();
        let most = streams.iter().map(Vec::len).max().unwrap_or(0);
        for from in (0..most).step_by(packet) {
            let parts: Vec<&[u8]> =
                streams.iter().map(|s| &s[from.min(s.len())..(from + packet).min(s.len())]).collect();
            let mut bytes = vec![1, 0, 0, 0];
            bytes.extend((parts.len() as u16).to_le_bytes());
            parts.iter().for_each(|p| bytes.extend((p.len() as u16).to_le_bytes()));
            parts.iter().for_each(|p| bytes.extend(*p));
            bytes.resize(bytes.len().next_multiple_of(4), 0);
            let size = (bytes.len() as u16 - 1).to_le_bytes();
            bytes[2..4].copy_from_slice(&size);
            // A packet without data between those with them.
            content.extend(if from == 0 { vec![2, 0, 3, 0] } else { vec![] });
            content.extend(bytes);
        }
        let length = (content.len() - start) as u64;
        content[start + 8..start + 16].copy_from_slice(&length.to_le_bytes());
        let fields: String = columns.iter().map(|c| format!("<{} {}/>", c.name, c.element)).collect();
        let (at, count) = (offset(start), columns.first().map_or(0, |c| c.values.len()));
        xml += &format!(
            "<vectorChild type=\"Structure\">{pose}<points type=\"CompressedVector\" fileOffset=\"{at}\" recordCount=\"{count}\">\
             <prototype type=\"Structure\">{fields}</prototype></points></vectorChild>"
        );
    }
    xml += &format!("</data3D>{more}</e57Root>");
    let at = offset(content.len());
    content[24..32].copy_from_slice(&at.to_le_bytes());
    content[32..40].copy_from_slice(&(xml.len() as u64).to_le_bytes());
    content.extend(xml.into_bytes());
    paged(content)
}

/// The warnings before the points, the points, and what is told behind them.
type Whole = (Vec<Warning>, Vec<Point>, Vec<String>);

fn points(bytes: &[u8], block: usize) -> std::result::Result<Whole, Located> {
    let source = Source { feed: Feed::memory(bytes.to_vec()), bytes: bytes.len() as u64, gzip: false };
    let mut parsed = read(source, &ReadOptions { block, ..ReadOptions::default() })?;
    let crate::format::Content::Points(stream) = &mut parsed.content else { panic!("no points") };
    let (mut all, mut block) = (vec![], vec![]);
    loop {
        stream.next_block(&mut block)?;
        if block.is_empty() {
            return Ok((parsed.warnings, all, stream.remarks()));
        }
        all.append(&mut block);
    }
}

fn said(bytes: &[u8]) -> String {
    points(bytes, 100).map(|_| ()).unwrap_err().fault.to_string()
}

const COUNT: usize = 3000;

/// A quarter turn about z and a shift.
const POSE: &str = "<pose type=\"Structure\"><rotation type=\"Structure\"><w>2</w><x/><y/><z>2</z></rotation>\
                    <translation type=\"Structure\"><x>100</x><y>-5</y><z>1e6</z></translation></pose>";

fn cartesian() -> Vec<Made> {
    let values = |k: f64| (0..COUNT).map(move |i| i as f64 * k);
    vec![
        Made {
            name: "colorRed",
            element: "type=\"Integer\" minimum=\"0\" maximum=\"255\"",
            bits: 8,
            values: vec![7; COUNT],
        },
        doubles("cartesianY", values(0.5)),
        // From −100 on, 13 bits: the numbers go over the borders of bytes and packets.
        Made {
            name: "cartesianX",
            element: "type=\"ScaledInteger\" minimum=\"-100\" maximum=\"8000\" scale=\"0.25\" offset=\"3\"",
            bits: 13,
            values: (0..COUNT as u64).collect(),
        },
        Made {
            name: "cartesianZ",
            element: "type=\"Integer\" minimum=\"4\" maximum=\"4\"",
            bits: 0,
            values: vec![0; COUNT],
        },
        Made {
            name: "cartesianInvalidState",
            element: "type=\"Integer\" minimum=\"0\" maximum=\"2\"",
            bits: 2,
            values: (0..COUNT as u64).map(|i| if i % 5 == 0 { 1 + i % 2 } else { 0 }).collect(),
        },
    ]
}

fn wanted(pose: bool) -> Vec<Point> {
    let all =
        (0..COUNT).filter(|i| i % 5 != 0).map(|i| [(i as f64 - 100.0) * 0.25 + 3.0, i as f64 * 0.5, 4.0]);
    all.map(|[x, y, z]| if pose { [100.0 - y, x - 5.0, z + 1e6] } else { [x, y, z] }).collect()
}

#[test]
fn scans_are_moved_by_their_poses_and_invalid_records_left_out() {
    let empty = vec![
        doubles("cartesianX", std::iter::empty()),
        doubles("cartesianY", std::iter::empty()),
        doubles("cartesianZ", std::iter::empty()),
    ];
    for packet in [100, 7001] {
        let scans = [(cartesian(), ""), (empty_of(&empty), POSE), (cartesian(), POSE)];
        let bytes = file(&scans, packet, "<images2D type=\"Vector\"><vectorChild/></images2D>");
        for block in [1, 999, 1 << 20] {
            let (warnings, found, remarks) = points(&bytes, block).unwrap_or_else(|e| panic!("{}", e.fault));
            let all = [wanted(false), wanted(true)].concat();
            assert_eq!(found.len(), all.len());
            let far =
                found.iter().zip(&all).map(|(a, b)| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max));
            assert!(far.fold(0.0, f64::max) < 1e-9);
            assert_eq!(
                remarks,
                [format!("{} point(s) that the file marks as invalid left out", 2 * COUNT / 5)]
            );
            let told: Vec<String> = warnings.iter().map(ToString::to_string).collect();
            assert_eq!(
                told,
                [
                    "3 scans read as one cloud, 1 of them empty",
                    "columns not read: colorRed",
                    "1 image(s) not read"
                ]
            );
        }
    }
}

fn empty_of(columns: &[Made]) -> Vec<Made> {
    columns.iter().map(|c| Made { values: vec![], ..*c }).collect()
}

#[test]
fn spherical_coordinates_become_cartesian() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let columns = vec![
        singles("sphericalRange", [1.0, 2.0, 3.0, f32::NAN].into_iter()),
        doubles("sphericalAzimuth", [0.0, quarter, 0.0, 0.0].into_iter()),
        doubles("sphericalElevation", [0.0, 0.0, -quarter, 0.0].into_iter()),
    ];
    let (_, found, remarks) = points(&file(&[(columns, "")], 4000, ""), 10).unwrap();
    let wanted = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, -3.0]];
    assert_eq!(found.len(), 3);
    assert!(found.iter().flatten().zip(wanted.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-15));
    assert_eq!(remarks, ["1 point(s) with a coordinate that is not finite left out"]);
}

#[test]
fn a_bit_turned_anywhere_in_the_pages_that_are_read_is_found() {
    let bytes = file(&[(cartesian(), "")], 4000, "");
    assert!(points(&bytes, 100).is_ok());
    for at in (50..bytes.len()).step_by(97) {
        let mut changed = bytes.clone();
        changed[at] ^= 4;
        assert!(said(&changed).contains("checksum (CRC)"), "byte {at}");
    }
    for end in (0..bytes.len()).step_by(331) {
        assert!(points(&bytes[..end], 100).is_err(), "{end}");
    }
}

#[test]
fn documents_that_cannot_be_are_refused() {
    let whole = file(&[(cartesian(), POSE)], 4000, "");
    let content: Vec<u8> = whole.chunks(1024).flat_map(|page| page[..1020].to_vec()).collect();
    let changed = |from: &str, to: &str| {
        let at = content.windows(from.len()).position(|w| w == from.as_bytes()).unwrap();
        let end = content.iter().rposition(|b| *b != 0).unwrap() + 1;
        let mut new = [&content[..at], to.as_bytes(), &content[at + from.len()..end]].concat();
        let length =
            u64::from_le_bytes(new[32..40].try_into().unwrap()) + to.len() as u64 - from.len() as u64;
        new[32..40].copy_from_slice(&length.to_le_bytes());
        said(&paged(new))
    };
    assert!(changed("<w>2</w><x/><y/><z>2</z>", "<w/><x/><y/><z/>").contains("quaternion 0 0 0 0"));
    assert!(changed("<w>2</w>", "<w>a</w>").contains("number in the pose"));
    assert!(changed("<w>2</w>", "").contains("no w"));
    assert!(
        changed("recordCount=\"3000\"", "recordCount=\"1000000000000\"").contains("1000000000000 records")
    );
    assert!(changed("recordCount=\"3000\"", "recordCount=\"-1\"").contains("recordCount"));
    assert!(changed("fileOffset=\"48\"", "fileOffset=\"1022\"").contains("offset 1022"));
    assert!(changed("fileOffset=\"48\"", "fileOffset=\"99999999\"").contains("offset 99999999"));
    assert!(changed("cartesianX ", "cartesianW ").contains("neither Cartesian nor spherical"));
    assert!(changed("maximum=\"255\"", "maximum=\"-1\"").contains("minimum 0 above its maximum -1"));
    assert!(
        changed("<colorRed type=\"Integer\" minimum=\"0\" maximum=\"255\"/>", "")
            .contains("number of columns")
    );
    assert!(changed("type=\"Integer\"", "type=\"Blob\"").contains("type Blob"));
    let bomb = "<?xml version=\"1.0\"?><!DOCTYPE a [<!ENTITY b \"c\">]>";
    assert!(changed("<?xml version=\"1.0\"?>", bomb).contains("DTD"));
    assert!(changed("</e57Root>", "").contains("document cannot be read"));
    assert!(said(&file(&[], 100, "<images2D><vectorChild/></images2D>")).contains("1 image(s), but no scan"));
}

#[test]
fn elements_nested_without_end_are_no_danger() {
    let deep = "<a>".repeat(200_000);
    let bytes = file(&[(cartesian(), "")], 4000, &deep);
    assert!(!said(&bytes).is_empty());
}
