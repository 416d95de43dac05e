//! Vertices in bytes to blocks of points.

use super::{
    faces,
    header::{Element, Encoding, Kind, Property, Scalar},
};
use crate::{
    error::{Fault, Located, Result},
    feed::Feed,
};
use rayon::prelude::*;
use trueness_geom::{cloud::PointStream, space::Point};

/// Vertices of one task.
const CHUNK: usize = 1 << 13;

/// Where a coordinate is in a row: offset and type.
type Place = (usize, Scalar);

/// Points of rows of bytes.
pub(super) struct BinaryPoints {
    feed: Feed,
    encoding: Encoding,
    vertex: Element,
    /// Bytes of a row; `None` where rows hold lists.
    stride: Option<usize>,
    places: [Place; 3],
    found: u64,
    block: usize,
}

impl BinaryPoints {
    pub fn new(
        feed: Feed,
        encoding: Encoding,
        vertex: &Element,
        xyz: [(usize, &Property); 3],
        block: usize,
    ) -> Result<BinaryPoints> {
        let before =
            |i: usize| Element { properties: vertex.properties[..i].to_vec(), ..vertex.clone() }.stride();
        let place = |(i, p): (usize, &Property)| match (before(i), p.kind) {
            (Some(offset), Kind::One(scalar)) => Ok((offset, scalar)),
            _ => {
                let what = "a list before the coordinates of a vertex cannot be read:".into();
                let remedy = "let the program that wrote this put x, y, z first";
                Err(Located::from(Fault::Unsupported { what, remedy }))
            }
        };
        let places = [place(xyz[0])?, place(xyz[1])?, place(xyz[2])?];
        let least = vertex.least_stride() as u64;
        if let Some(left) = feed.left()
            && vertex.count.checked_mul(least).is_none_or(|need| need > left)
        {
            let present = left / least.max(1);
            return Err(
                Fault::Short { what: "vertices", declared: vertex.count, present }.at_byte(feed.position())
            );
        }
        let (stride, vertex) = (vertex.stride(), vertex.clone());
        Ok(BinaryPoints { feed, encoding, vertex, stride, places, found: 0, block: block.max(1) })
    }

    pub fn into_rest(self) -> Feed {
        self.feed
    }

    fn short(&self) -> Located {
        Fault::Short { what: "vertices", declared: self.vertex.count, present: self.found }
            .at_byte(self.feed.position())
    }

    /// Rows of the same length, many at a time.
    fn fixed(&mut self, stride: usize, count: usize, block: &mut Vec<Point>) -> Result<()> {
        let bytes = self.feed.ahead(count.saturating_mul(stride))?;
        let there = (bytes.len() / stride).min(count);
        if there == 0 {
            return Err(self.short());
        }
        let rows = &bytes[..there * stride];
        block.resize(there, [0.0; 3]);
        let (places, encoding) = (self.places, self.encoding);
        let whole = places.iter().all(|p| p.1 == Scalar::F32) && encoding == Encoding::Little;
        block.par_chunks_mut(CHUNK).zip(rows.par_chunks(CHUNK * stride)).for_each(|(out, rows)| {
            let rows = rows.chunks_exact(stride);
            if whole {
                // By far the most common kind, without asking for the type of each number.
                out.iter_mut().zip(rows).for_each(|(p, row)| {
                    *p = places.map(|(at, _)| Scalar::F32.get(&row[at..], Encoding::Little));
                });
            } else {
                out.iter_mut()
                    .zip(rows)
                    .for_each(|(p, row)| *p = places.map(|(at, s)| s.get(&row[at..], encoding)));
            }
        });
        self.feed.step(there * stride);
        Ok(())
    }

    /// Rows with lists, one after the other.
    fn loose(&mut self, count: usize, block: &mut Vec<Point>) -> Result<()> {
        block.clear();
        for _ in 0..count {
            let Some(length) = faces::row_length(&mut self.feed, &self.vertex, self.encoding)? else {
                return Err(self.short());
            };
            let row = self.feed.ahead(length)?;
            block.push(self.places.map(|(at, s)| s.get(row.get(at..).unwrap_or_default(), self.encoding)));
            self.feed.step(length);
        }
        Ok(())
    }
}

impl PointStream for BinaryPoints {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.vertex.count)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        let left = self.vertex.count - self.found;
        let count = self.block.min(usize::try_from(left).unwrap_or(usize::MAX));
        if count == 0 {
            block.clear();
            return Ok(());
        }
        let at = self.feed.position();
        match self.stride {
            Some(stride) => self.fixed(stride, count, block)?,
            None => self.loose(count, block)?,
        }
        let bad = |p: &Point| !p.iter().all(|x| x.is_finite());
        if let Some(i) = block.par_iter().position_first(bad) {
            let number = self.found + i as u64 + 1;
            return Err(Fault::NotFinite { what: "vertex", number }
                .at_byte(at + (i * self.stride.unwrap_or(0)) as u64));
        }
        self.found += block.len() as u64;
        Ok(())
    }
}
