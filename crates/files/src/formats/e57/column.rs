//! The numbers of a column, packed bit by bit over the packets of a scan.

/// How numbers are packed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Single,
    Double,
    /// The difference from a minimum in as many bits as the range takes, times a scale plus an offset.
    Integer {
        min: i64,
        scale: f64,
        offset: f64,
    },
}

/// A column: its numbers have `bits` bits each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Packed {
    kind: Kind,
    pub bits: usize,
}

impl Packed {
    /// Numbers in floating point.
    pub fn floating(kind: Kind) -> Packed {
        Packed { kind, bits: if kind == Kind::Single { 32 } else { 64 } }
    }
    /// Integers of a range.
    pub fn integer((min, max): (i64, i64), scale: f64, offset: f64) -> Packed {
        let bits = 64 - max.wrapping_sub(min).cast_unsigned().leading_zeros() as usize;
        Packed { kind: Kind::Integer { min, scale, offset }, bits }
    }
}

/// The bytes of a column that have been read and not used up.
pub(super) struct Column {
    packed: Packed,
    bytes: Vec<u8>,
    /// Bits used up.
    used: usize,
}

impl Column {
    pub fn new(packed: Packed) -> Column {
        Column { packed, bytes: vec![], used: 0 }
    }

    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// How many numbers are there; `None` where all are the same and take no bits.
    pub fn available(&self) -> Option<usize> {
        (8 * self.bytes.len() - self.used).checked_div(self.packed.bits)
    }

    /// Number `i` of those that are there.
    #[inline]
    pub fn get(&self, i: usize) -> f64 {
        let bit = self.used + i * self.packed.bits;
        match self.packed.kind {
            Kind::Single => f64::from(f32::from_le_bytes(self.chunk(bit / 8))),
            Kind::Double => f64::from_le_bytes(self.chunk(bit / 8)),
            Kind::Integer { min, scale, offset } => {
                let bits = u128::from_le_bytes(self.chunk(bit / 8)) >> (bit % 8);
                let mask = (1u128 << self.packed.bits) - 1;
                min.wrapping_add((bits & mask) as i64) as f64 * scale + offset
            }
        }
    }

    /// Bytes from a place on, zeros behind the last one.
    #[inline]
    fn chunk<const N: usize>(&self, at: usize) -> [u8; N] {
        let rest = self.bytes.get(at..).unwrap_or_default();
        rest.first_chunk().copied().unwrap_or_else(|| {
            let mut padded = [0; N];
            padded.iter_mut().zip(rest).for_each(|(out, b)| *out = *b);
            padded
        })
    }

    /// Uses up so many numbers.
    pub fn step(&mut self, count: usize) {
        self.used += count * self.packed.bits;
        self.bytes.drain(..self.used / 8);
        self.used %= 8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_of_every_width_come_back_however_their_bytes_are_cut() {
        for bits in 0..=64u32 {
            let max = if bits == 64 { u64::MAX } else { (1 << bits) - 1 };
            let min = if bits == 64 { i64::MIN } else { -5 };
            let values: Vec<u64> = (0..40u64).map(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) & max).collect();
            let mut bytes = vec![0u8; (40 * bits as usize).div_ceil(8)];
            for (i, value) in values.iter().enumerate() {
                for b in 0..bits as usize {
                    let at = i * bits as usize + b;
                    bytes[at / 8] |= ((value >> b & 1) as u8) << (at % 8);
                }
            }
            let packed = Packed::integer((min, min.wrapping_add(max as i64)), 1.0, 0.0);
            assert_eq!(packed.bits, bits as usize);
            let mut column = Column::new(packed);
            let mut seen = 0;
            for part in bytes.chunks(3).chain(std::iter::once(&[][..])) {
                column.push(part);
                let there = column.available().unwrap_or(40).min(40 - seen);
                (0..there).for_each(|i| {
                    assert_eq!(
                        column.get(i),
                        min.wrapping_add(values[seen + i] as i64) as f64,
                        "{bits} bits"
                    );
                });
                column.step(there);
                seen += there;
            }
            assert_eq!(seen, 40);
        }
    }
}
