//! LAS and LAZ: every point format, plain and packed; what the head says wrongly; units; flags.

use super::*;
use crate::error::Located;
use crate::feed::Feed;
use laz::laszip::{LasZipCompressor, LazVlrBuilder};
use laz::{LazItemRecordBuilder, LazVlr};
use std::io::Cursor;
use trueness_geom::num::random::Random;
use trueness_geom::space::Point;

const STEP_SIZES: Point = [0.001, 0.25, 1e-7];
const OFFSET: Point = [500_000.0, -4e6, 0.1];
const RECORD_LENGTHS: [u16; 11] = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67];

/// A file before its records are added.
struct Made {
    format: u8,
    extra: u16,
    vlrs: Vec<(&'static str, u16, Vec<u8>)>,
}

impl Made {
    fn of(format: u8) -> Made {
        Made { format, extra: 0, vlrs: vec![] }
    }

    fn length(&self) -> usize {
        usize::from(RECORD_LENGTHS[usize::from(self.format)] + self.extra)
    }

    fn records(&self, steps: &[[i32; 3]]) -> Vec<u8> {
        let one = |(i, step): (usize, &[i32; 3])| {
            let mut record = vec![0u8; self.length()];
            record[..12].copy_from_slice(&step.map(i32::to_le_bytes).concat());
            if i % 10 == 0 {
                record[15] = if self.format < 6 { 1 << 7 } else { 1 << 2 };
            }
            record
        };
        steps.iter().enumerate().flat_map(one).collect()
    }

    /// The head, of version 1.4, for `points` points, packed or not.
    fn head(&self, points: u64, packed: bool) -> Vec<u8> {
        let vlrs: Vec<u8> =
            self.vlrs.iter().flat_map(|(user, id, content)| vlr(user, *id, content)).collect();
        let mut head = vec![0u8; 375];
        let mut put = |at: usize, bytes: &[u8]| head[at..at + bytes.len()].copy_from_slice(bytes);
        put(0, b"LASF");
        put(24, &[1, 4]);
        put(94, &375u16.to_le_bytes());
        put(96, &(375 + vlrs.len() as u32).to_le_bytes());
        put(100, &(self.vlrs.len() as u32).to_le_bytes());
        put(104, &[self.format | if packed { 0x80 } else { 0 }]);
        put(105, &(self.length() as u16).to_le_bytes());
        put(131, &STEP_SIZES.map(f64::to_le_bytes).concat());
        put(155, &OFFSET.map(f64::to_le_bytes).concat());
        put(247, &points.to_le_bytes());
        [head, vlrs].concat()
    }

    fn plain(&self, steps: &[[i32; 3]]) -> Vec<u8> {
        [self.head(steps.len() as u64, false), self.records(steps)].concat()
    }

    /// Packed in chunks of so many points, or in chunks of many sizes.
    fn packed(&self, steps: &[[i32; 3]], chunk: Option<u32>) -> Vec<u8> {
        let items = LazItemRecordBuilder::default_for_point_format_id(self.format, self.extra).unwrap();
        let builder = LazVlrBuilder::new(items);
        let vlr = match chunk {
            Some(chunk) => builder.with_fixed_chunk_size(chunk).build(),
            None => builder.with_variable_chunk_size().build(),
        };
        let mut content = vec![];
        vlr.write_to(&mut content).unwrap();
        let mut vlrs = self.vlrs.clone();
        vlrs.push((LazVlr::USER_ID, LazVlr::RECORD_ID, content));
        let head = Made { format: self.format, extra: self.extra, vlrs }.head(steps.len() as u64, true);
        let start = head.len() as u64;
        let mut file = Cursor::new(head);
        file.set_position(start);
        let mut compressor = LasZipCompressor::new(file, vlr).unwrap();
        let records = self.records(steps);
        match chunk {
            Some(_) => compressor.compress_many(&records).unwrap(),
            None => {
                for (i, part) in records.chunks(self.length() * 37).enumerate() {
                    let half = part.len() / self.length() / 2 * self.length();
                    compressor
                        .compress_chunks([&part[..half], &part[half..]].iter().filter(|p| !p.is_empty()))
                        .unwrap();
                    assert!(i < 1000);
                }
            }
        }
        compressor.done().unwrap();
        compressor.into_inner().into_inner()
    }
}

fn vlr(user: &str, id: u16, content: &[u8]) -> Vec<u8> {
    let mut head = vec![0u8; 54];
    head[2..2 + user.len()].copy_from_slice(user.as_bytes());
    head[18..20].copy_from_slice(&id.to_le_bytes());
    head[20..22].copy_from_slice(&(content.len() as u16).to_le_bytes());
    [&head, content].concat()
}

fn steps(count: usize) -> Vec<[i32; 3]> {
    let mut random = Random::new(5);
    (0..count).map(|i| std::array::from_fn(|_| i as i32 * 7 + random.below(1000) as i32 - 500)).collect()
}

fn wanted(steps: &[[i32; 3]]) -> Vec<Point> {
    steps.iter().map(|s| std::array::from_fn(|i| f64::from(s[i]) * STEP_SIZES[i] + OFFSET[i])).collect()
}

fn points(
    bytes: &[u8],
    options: &ReadOptions,
) -> std::result::Result<(Parsed, Vec<Point>, Vec<String>), Located> {
    let source = Source { feed: Feed::memory(bytes.to_vec()), bytes: bytes.len() as u64, gzip: false };
    let mut parsed = read(source, options)?;
    let crate::format::Content::Points(stream) = &mut parsed.content else { panic!("no points") };
    let (mut all, mut block) = (vec![], vec![]);
    loop {
        stream.next_block(&mut block)?;
        if block.is_empty() {
            break;
        }
        all.append(&mut block);
    }
    let remarks = stream.remarks();
    Ok((parsed, all, remarks))
}

fn said(bytes: &[u8]) -> String {
    points(bytes, &ReadOptions::default()).map(|_| ()).unwrap_err().fault.to_string()
}

#[test]
fn every_point_format_gives_its_places_plain_and_packed() {
    let steps = steps(500);
    for format in 0..=10 {
        for extra in [0, 3] {
            let made = Made { extra, ..Made::of(format) };
            let files = [
                made.plain(&steps),
                made.packed(&steps, Some(64)),
                made.packed(&steps, Some(5000)),
                made.packed(&steps, None),
            ];
            for (i, file) in files.iter().enumerate() {
                for block in [7, 1 << 20] {
                    let options = ReadOptions { block, ..ReadOptions::default() };
                    let (parsed, found, remarks) = points(file, &options)
                        .unwrap_or_else(|e| panic!("{format} {extra} {i}: {}", e.fault));
                    assert_eq!(found, wanted(&steps), "format {format}, {extra} extra bytes, file {i}");
                    assert_eq!(
                        remarks,
                        ["50 point(s) that the file marks as withheld were read like the others"]
                    );
                    let told = format!("{:?}", parsed.warnings);
                    assert_eq!(told.contains("WavePackets"), matches!(format, 4 | 5 | 9 | 10));
                    assert_eq!(told.contains("3 bytes without a name"), extra == 3);
                }
                for cut in [1, file.len() / 3] {
                    assert!(
                        points(&file[..file.len() - cut], &ReadOptions::default()).is_err(),
                        "{format} {i} {cut}"
                    );
                }
            }
        }
    }
}

#[test]
fn large_chunks_are_unpacked_a_part_at_a_time() {
    let steps = steps((1 << 20) + 5);
    let file = Made::of(6).packed(&steps, Some(u32::MAX - 1));
    let options = ReadOptions { block: 1 << 18, ..ReadOptions::default() };
    assert_eq!(points(&file, &options).unwrap().1, wanted(&steps));
}

#[test]
fn heads_that_cannot_be_are_refused() {
    let sound = Made { vlrs: vec![("someone", 1, vec![1, 2, 3])], ..Made::of(1) }.plain(&steps(20));
    let changed = |at: usize, bytes: &[u8]| {
        let mut file = sound.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        said(&file)
    };
    assert!(
        changed(247, &(1u64 << 60).to_le_bytes()).contains("1152921504606846976 points declared, 20 present")
    );
    assert!(changed(131, &f64::NAN.to_le_bytes()).contains("scale of x is NaN"));
    assert!(changed(139, &0f64.to_le_bytes()).contains("scale of y is 0"));
    assert!(changed(171, &f64::INFINITY.to_le_bytes()).contains("offset inf"));
    assert!(changed(100, &9u32.to_le_bytes()).contains("9 VLRs before the points declared, 1 present"));
    assert!(changed(105, &27u16.to_le_bytes()).contains("28 bytes, not 27"));
    assert!(changed(104, &[11]).contains("format 11"));
    assert!(changed(104, &[0x81]).contains("no VLR of LASzip"));
    assert!(changed(94, &[9, 0]).contains("header"));
    assert!(changed(243, &[1]).contains("EVLRs"));
}

#[test]
fn packings_that_cannot_be_are_refused() {
    let sound = Made::of(7).packed(&steps(500), Some(64));
    let start = u32::from_le_bytes(sound[96..100].try_into().unwrap()) as usize;
    let table = i64::from_le_bytes(sound[start..start + 8].try_into().unwrap()) as usize;
    let changed = |at: usize, bytes: &[u8]| {
        let mut file = sound.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        said(&file)
    };
    assert!(changed(start, &(-5i64).to_le_bytes()).contains("table of chunks is said to be at byte -5"));
    assert!(changed(start, &(1i64 << 50).to_le_bytes()).contains("before its table of chunks"));
    assert!(changed(table + 4, &u32::MAX.to_le_bytes()).contains("4294967295 chunks"));
    assert!(
        changed(table + 4, &1u32.to_le_bytes()).contains("500 points in the chunks declared, 64 present")
    );
    // The lengths of the layers follow the first record and a count.
    assert!(changed(start + 8 + 36 + 4, &u32::MAX.to_le_bytes()).contains("layers of a chunk"));
    // The record of LASzip: its method, and the size of its first item.
    let record = start - 34 - 2 * 6;
    assert!(changed(record, &[9]).contains("method"));
    assert!(changed(record + 34 + 2, &[31]).contains("37 bytes, not 36"));
}

/// Flipped bits break the codes in ways that the decoder asserts against: the file is refused or gives its points, no more of them.
#[test]
fn flipped_bits_are_faults_of_the_file() {
    let (steps, random) = (steps(200), &mut Random::new(9));
    let mut refused = 0;
    for format in 0..=10 {
        let sound = Made::of(format).packed(&steps, Some(64));
        let start = u32::from_le_bytes(sound[96..100].try_into().unwrap()) as usize;
        for _ in 0..200 {
            let mut file = sound.clone();
            let at = start + random.below((file.len() - start) as u64) as usize;
            file[at] ^= 1 << random.below(8);
            match points(&file, &ReadOptions::default()) {
                Ok((_, found, _)) => assert_eq!(found.len(), steps.len()),
                Err(_) => refused += 1,
            }
        }
    }
    assert!(refused > 100, "{refused}");
}

#[test]
fn the_unit_is_that_of_the_coordinate_system() {
    let keys = |entries: &[[u16; 4]]| {
        let head = [1, 1, 0, entries.len() as u16];
        std::iter::once(&head).chain(entries).flatten().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>()
    };
    let file =
        |content| Made { vlrs: vec![("LASF_Projection", 34735, content)], ..Made::of(0) }.plain(&steps(2));
    let told = |content| {
        let parsed = points(&file(content), &ReadOptions::default()).unwrap().0;
        (parsed.unit, parsed.warnings)
    };
    let scan = |w| vec![Warning::Scan(w)];
    assert_eq!(told(keys(&[[3076, 0, 1, 9001]])), (Some(Unit::Meter), vec![]));
    let feet = Unit::SurveyFoot;
    assert_eq!(told(keys(&[[3076, 0, 1, 9003]])), (Some(feet), scan(ScanWarning::Feet { unit: feet })));
    assert_eq!(told(vec![]), (None, scan(ScanWarning::UnitUnstated)));
    let height = ScanWarning::HeightUnit { taken: Unit::Meter, height: Unit::Foot };
    assert_eq!(told(keys(&[[3076, 0, 1, 9001], [4099, 0, 1, 9002]])), (Some(Unit::Meter), scan(height)));
    let degrees = file(keys(&[[1024, 0, 1, 2]]));
    assert!(said(&degrees).contains("degrees"));
    let asked = ReadOptions { units: Some(Unit::Meter), ..ReadOptions::default() };
    let (parsed, read, _) = points(&degrees, &asked).unwrap();
    assert!(read.len() == 2 && parsed.warnings[0].to_string().contains("degrees"), "{:?}", parsed.warnings);
}
