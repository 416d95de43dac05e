//! Points of packed records: small chunks by all threads at once, large ones a part at a time.

use super::{
    record::{Layout, Tally},
    zip_table::{Chunk, Kind, Packing, fault},
};
use crate::{
    error::{Fault, Located, Result},
    feed::Feed,
};
use laz::{
    DecompressionSelection,
    record::{LayeredPointRecordDecompressor, RecordDecompressor, SequentialPointRecordDecompressor},
};
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use trueness_geom::parallel::prelude::*;
use trueness_geom::{cloud::PointStream, space::Point};

/// A chunk with more points is unpacked a part at a time.
const MAX_POINTS_PER_TASK: u64 = 1 << 20;

/// Points of chunks, in their order.
pub(super) struct ZippedPoints {
    feed: Feed,
    /// Chunks that are not begun.
    chunks: std::vec::IntoIter<Chunk>,
    unpacking: Unpacking,
    /// A large chunk that is not read to its end.
    open: Option<OpenChunk>,
    declared: u64,
    /// Points that are not in chunks begun.
    left: u64,
    block: usize,
    tally: Tally,
}

/// What all chunks have in common.
struct Unpacking {
    packing: Packing,
    layout: Layout,
}

/// A chunk that is being unpacked.
struct OpenChunk {
    decoder: Box<dyn RecordDecompressor<Cursor<Arc<[u8]>>> + Send + Sync>,
    left: u64,
    record: Vec<u8>,
}

impl ZippedPoints {
    pub fn new(
        mut feed: Feed,
        layout: Layout,
        declared: u64,
        zip: &[u8],
        block: usize,
    ) -> Result<ZippedPoints> {
        let packing = Packing::read(zip, layout.length)?;
        let chunks = packing.chunks(&mut feed, declared, layout.length)?;
        Ok(ZippedPoints {
            feed,
            chunks: chunks.into_iter(),
            unpacking: Unpacking { packing, layout },
            open: None,
            declared,
            left: declared,
            block: block.max(1),
            tally: Tally::default(),
        })
    }

    /// The packed bytes of the next chunk, and how many of its points count.
    fn next_chunk(&mut self) -> Result<Option<(Arc<[u8]>, u64)>> {
        if self.left == 0 {
            return Ok(None);
        }
        let Some(chunk) = self.chunks.next() else {
            return Err(Fault::Short {
                what: "points in the chunks",
                declared: self.declared,
                present: self.declared - self.left,
            }
            .into());
        };
        let points = chunk.points.min(self.left);
        let size = usize::try_from(chunk.bytes).unwrap_or(usize::MAX);
        let at = self.feed.position();
        let there = self.feed.ahead(size)?;
        let Some(bytes) = there.get(..size) else {
            let present = there.len() as u64;
            return Err(Fault::Short { what: "bytes of a chunk", declared: chunk.bytes, present }.at_byte(at));
        };
        let bytes = Arc::from(bytes);
        self.feed.step(size);
        self.left -= points;
        Ok(Some((bytes, points)))
    }
}

impl PointStream for ZippedPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.declared)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        block.clear();
        while block.is_empty() {
            if let Some(open) = &mut self.open {
                let at = self.feed.position();
                let most = self.block as u64;
                self.tally +=
                    open.take(most, &self.unpacking.layout, block).map_err(|fault| fault.at_byte(at))?;
                self.open = self.open.take().filter(|open| open.left > 0);
                continue;
            }
            let (at, mut batch, mut points) = (self.feed.position(), vec![], 0);
            while points < self.block as u64 {
                let Some((bytes, count)) = self.next_chunk()? else { break };
                if count > MAX_POINTS_PER_TASK {
                    self.open = Some(self.unpacking.open(bytes, count).map_err(|fault| fault.at_byte(at))?);
                    break;
                }
                points += count;
                batch.push((bytes, count));
            }
            if batch.is_empty() && self.open.is_none() {
                return Ok(());
            }
            let unpacking = &self.unpacking;
            let parts: Vec<_> =
                batch.into_par_iter().map(|(bytes, count)| unpacking.whole(bytes, count)).collect();
            for part in parts {
                let (points, tally) = part.map_err(|fault| fault.at_byte(at))?;
                block.extend_from_slice(&points);
                self.tally += tally;
            }
        }
        Ok(())
    }
    fn remarks(&self) -> Vec<String> {
        self.tally.remarks()
    }
}

impl Unpacking {
    /// All points of a chunk.
    fn whole(&self, bytes: Arc<[u8]>, count: u64) -> std::result::Result<(Vec<Point>, Tally), Fault> {
        let mut points = vec![];
        let tally = self.open(bytes, count)?.take(count, &self.layout, &mut points)?;
        Ok((points, tally))
    }

    /// A chunk at its start.
    fn open(&self, bytes: Arc<[u8]>, left: u64) -> std::result::Result<OpenChunk, Fault> {
        let length = self.layout.length;
        let layered = self.packing.kind == Kind::Layers;
        if layered {
            check_layers(&bytes, length, self.packing.layers)?;
        }
        let source = Cursor::new(bytes);
        let mut decoder: Box<dyn RecordDecompressor<_> + Send + Sync> = match layered {
            true => Box::new(LayeredPointRecordDecompressor::new(source)),
            false => Box::new(SequentialPointRecordDecompressor::new(source)),
        };
        decoder.set_fields_from(self.packing.vlr.items()).map_err(|e| fault(&e))?;
        if decoder.record_size() != length {
            return Err(Fault::contradiction(format!(
                "the packed records have {} bytes, not {length}",
                decoder.record_size()
            )));
        }
        // Only places, flags and times are looked at.
        let wanted =
            DecompressionSelection::base().decompress_z().decompress_classification().decompress_flags();
        decoder.set_selection(wanted.decompress_gps_time());
        Ok(OpenChunk { decoder, left, record: vec![0; length] })
    }
}

impl OpenChunk {
    /// Appends the next points, at most `most`.
    fn take(
        &mut self,
        most: u64,
        layout: &Layout,
        out: &mut Vec<Point>,
    ) -> std::result::Result<Tally, Fault> {
        let mut tally = Tally::default();
        let count = most.min(self.left);
        for _ in 0..count {
            next_record(&mut *self.decoder, &mut self.record).map_err(|e| match e.kind() {
                std::io::ErrorKind::UnexpectedEof => {
                    Fault::contradiction("a chunk ends before its last point")
                }
                _ => fault(&e),
            })?;
            out.push(layout.point(&self.record, &mut tally));
        }
        self.left -= count;
        Ok(tally)
    }
}

/// Unpacks a record. The decoder asserts what damaged codes break: that is a fault of the file, and its chunk is given up.
fn next_record(
    decoder: &mut (dyn RecordDecompressor<Cursor<Arc<[u8]>>> + Send + Sync),
    record: &mut [u8],
) -> std::io::Result<()> {
    catch_unwind(AssertUnwindSafe(|| decoder.decompress_next(record)))
        .unwrap_or_else(|_| Err(std::io::Error::other("the codes of a chunk contradict each other")))
}

/// Refuses a chunk of layers that are longer than the chunk.
fn check_layers(bytes: &[u8], length: usize, layers: usize) -> std::result::Result<(), Fault> {
    let sizes = bytes.get(length + 4..).unwrap_or_default().chunks_exact(4).take(layers);
    let mut sum = length as u64 + 4 + 4 * layers as u64;
    for size in sizes {
        sum += u64::from(u32::from_le_bytes([size[0], size[1], size[2], size[3]]));
    }
    let there = bytes.len() as u64;
    if sum > there {
        return Err(Fault::contradiction(format!(
            "the layers of a chunk take {sum} bytes, but it has {there}"
        )));
    }
    Ok(())
}
