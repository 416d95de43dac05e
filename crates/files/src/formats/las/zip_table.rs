//! How the records of a LAZ file are packed, and where its chunks are.
//!
//! The library that unpacks trusts these numbers: it asks for memory for as many chunks and bytes as they say. So they are held
//! against the bytes that are there before.

use crate::{
    error::{Fault, Located, Result},
    feed::Feed,
};
use laz::{LazItemType, LazVlr, laszip::ChunkTable};
use std::io::Cursor;

/// How records are packed.
pub(super) struct Packing {
    pub vlr: LazVlr,
    /// One run of all records, in chunks, or in chunks of layers.
    pub kind: Kind,
    /// Lengths of layers that stand at the head of a chunk.
    pub layers: usize,
}

/// The order of the packed bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// All records one after the other.
    Run,
    /// Chunks of records one after the other.
    Chunks,
    /// Chunks in which each field is a layer.
    Layers,
}

/// A chunk: its packed bytes and its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Chunk {
    pub bytes: u64,
    pub points: u64,
}

/// Bytes before the list of items in the record of LASzip, and of an item.
const ITEMS_AT: usize = 34;
const ITEM_BYTES: usize = 6;

impl Packing {
    /// What the record of LASzip says of records of `length` bytes.
    pub fn read(record: &[u8], length: usize) -> Result<Packing> {
        let count = record.get(32..ITEMS_AT).map_or(0, |b| usize::from(u16::from_le_bytes([b[0], b[1]])));
        let items = record.get(ITEMS_AT..).unwrap_or_default().chunks_exact(ITEM_BYTES).take(count);
        let sizes: Vec<usize> =
            items.map(|item| usize::from(u16::from_le_bytes([item[2], item[3]]))).collect();
        if sizes.len() != count || sizes.iter().sum::<usize>() != length || sizes.contains(&0) {
            let what = format!(
                "the VLR of LASzip describes records of {} bytes, not {length}",
                sizes.iter().sum::<usize>()
            );
            return Err(Fault::contradiction(what).into());
        }
        let kind = match record.first_chunk::<2>() {
            Some([1, 0]) => Kind::Run,
            Some([2, 0]) => Kind::Chunks,
            Some([3, 0]) => Kind::Layers,
            _ => {
                let what = "the points are packed by a method other than 1, 2 or 3".to_string();
                return Err(Fault::Unsupported { what, remedy: "unpack the file to LAS" }.into());
            }
        };
        let vlr = LazVlr::from_buffer(record).map_err(|e| fault(&e))?;
        let layers = vlr.items().iter().map(|item| layers(item.item_type())).sum();
        Ok(Packing { vlr, kind, layers })
    }

    /// The chunks of the points ahead of the feed, of which there are `points`; steps to their first byte.
    pub fn chunks(&self, feed: &mut Feed, points: u64, length: usize) -> Result<Vec<Chunk>> {
        if self.kind == Kind::Run || points == 0 {
            let bytes = feed.all()?.len() as u64;
            return Ok(vec![Chunk { bytes, points }]);
        }
        let at = feed.position();
        let table = table_at(feed)?;
        feed.step(OFFSET_BYTES);
        let data = table - at - OFFSET_BYTES as u64;
        let mut head = [0; 8];
        feed.copy(data, &mut head).map_err(|_| missing(table))?;
        let count = u64::from(u32::from_le_bytes([head[4], head[5], head[6], head[7]]));
        // The first record of a chunk is not packed.
        if count > data / length as u64 {
            let what = format!("the table of chunks has {count} chunks, but {data} packed bytes are there");
            return Err(Fault::contradiction(what).at_byte(table + 4));
        }
        let left = feed.count_left()?.saturating_sub(data);
        let mut bytes = vec![
            0;
            usize::try_from(left.min(TABLE_HEAD_BYTES + MAX_ENTRY_BYTES * count))
                .unwrap_or_default()
        ];
        feed.copy(data, &mut bytes)?;
        let is_varied = self.vlr.uses_variable_size_chunks();
        let entries = ChunkTable::read(&mut Cursor::new(bytes), is_varied);
        let entries = entries.map_err(|e| {
            Fault::contradiction(format!("the table of chunks is damaged: {e}")).at_byte(table)
        })?;
        let size = u64::from(self.vlr.chunk_size());
        let chunks: Vec<Chunk> = (&entries)
            .into_iter()
            .map(|entry| Chunk {
                bytes: entry.byte_count,
                points: if is_varied { entry.point_count } else { size },
            })
            .collect();
        self.check(&chunks, data, points).map_err(|fault| fault.at_byte(table))?;
        Ok(chunks)
    }

    fn check(&self, chunks: &[Chunk], data: u64, points: u64) -> std::result::Result<(), Fault> {
        let sum =
            |of: fn(&Chunk) -> u64| chunks.iter().map(of).try_fold(0, u64::checked_add).unwrap_or(u64::MAX);
        let (bytes, there) = (sum(|c| c.bytes), sum(|c| c.points));
        if bytes > data {
            return Err(Fault::contradiction(format!(
                "the table of chunks names {bytes} packed bytes, but {data} are there"
            )));
        }
        if there < points {
            return Err(Fault::Short { what: "points in the chunks", declared: points, present: there });
        }
        Ok(())
    }
}

/// Bytes before the first chunk: where the table is.
const OFFSET_BYTES: usize = 8;
/// Bytes of a table before its entries, with those that begin and end the packing; and of an entry, which has two numbers, at most.
const TABLE_HEAD_BYTES: u64 = 64;
const MAX_ENTRY_BYTES: u64 = 16;

/// The byte of the file at which the table of chunks begins. Where a writer could not go back to say it, it stands at the end.
fn table_at(feed: &mut Feed) -> Result<u64> {
    let at = feed.position();
    let mut offset = [0; OFFSET_BYTES];
    feed.copy(0, &mut offset)?;
    let mut place = i64::from_le_bytes(offset);
    if place == -1 {
        let left = feed.count_left()?;
        feed.copy(left.saturating_sub(OFFSET_BYTES as u64), &mut offset)?;
        place = i64::from_le_bytes(offset);
    }
    match u64::try_from(place) {
        Ok(place) if place >= at + OFFSET_BYTES as u64 => Ok(place),
        _ => {
            Err(Fault::contradiction(format!("the table of chunks is said to be at byte {place}"))
                .at_byte(at))
        }
    }
}

fn missing(table: u64) -> Located {
    Fault::contradiction("the file ends before its table of chunks").at_byte(table)
}

/// Lengths that an item has at the head of a chunk of layers: one for each of its layers.
fn layers(item: LazItemType) -> usize {
    match item {
        LazItemType::Point14 => 9,
        LazItemType::RGB14 | LazItemType::WavePacket14 => 1,
        LazItemType::RGBNIR14 => 2,
        LazItemType::Byte14(count) => usize::from(count),
        _ => 0,
    }
}

/// What the library says of a file.
pub(super) fn fault(error: &impl std::fmt::Display) -> Fault {
    Fault::Unsupported {
        what: format!("the packed points cannot be read: {error}"),
        remedy: "copy the file again, or unpack it to LAS",
    }
}
