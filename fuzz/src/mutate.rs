//! Changing bytes: blindly, as numbers, and as text.

use trueness_geom::num::random::Random;

/// Values at which counts and sizes go wrong.
const EDGES: [u64; 14] = [
    0,
    1,
    2,
    3,
    0x7f,
    0x80,
    0xff,
    0x7fff,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    0x7fff_ffff_ffff_ffff,
    u64::MAX,
];

/// Words at which parsers of numbers and lines go wrong.
const WORDS: [&[u8]; 34] = [
    b"0",
    b"-0",
    b"-1",
    b"1e999",
    b"1e-999",
    b"nan",
    b"-inf",
    b"inf",
    b"1.5",
    b".",
    b"-",
    b"+",
    b"e5",
    b"0x10",
    b"1,5",
    b"4294967295",
    b"4294967296",
    b"18446744073709551615",
    b"99999999999999999999999999",
    b"2147483648",
    b"1d3",
    b"\"",
    b"'",
    b"\n",
    b"\r",
    b"\r\n",
    b"\t",
    b"\0",
    b"#",
    b"\\",
    b"\xef\xbb\xbf",
    b"\xff\xfe",
    b" ",
    b"//",
];

/// The longest case.
const LONGEST: usize = 1 << 16;

/// A number below `n`.
pub fn below(random: &mut Random, n: usize) -> usize {
    random.below(n as u64) as usize
}

/// A length from 1 to 2^`most`, short ones more often.
fn length(random: &mut Random, most: u64) -> usize {
    let scale = 1 << random.below(most);
    1 + below(random, scale)
}

/// A case made of `bytes`: one to eight changes. `other` gives pieces, `words` are those of the format.
pub fn mutated(random: &mut Random, bytes: &[u8], other: &[u8], words: &[&[u8]]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    for _ in 0..1 << random.below(4) {
        change(random, &mut out, other, words);
    }
    out.truncate(LONGEST);
    out
}

fn change(random: &mut Random, out: &mut Vec<u8>, other: &[u8], words: &[&[u8]]) {
    if out.is_empty() {
        out.extend(other);
        return;
    }
    let at = below(random, out.len());
    let rest = out.len() - at;
    let length = length(random, 8).min(rest);
    match random.below(16) {
        0 => out[at] ^= 1 << random.below(8),
        1 => out[at] = random.next_u64() as u8,
        2 => out.truncate(at),
        3 => drop(out.drain(at..at + length)),
        4 => {
            let piece = out[at..at + length].to_vec();
            let to = below(random, out.len() + 1);
            insert(out, to, &piece);
        }
        5 => {
            let piece = out[at..at + length].to_vec();
            let to = below(random, out.len() - length + 1);
            out[to..to + length].copy_from_slice(&piece);
        }
        6 => {
            let piece = piece(random, other).to_vec();
            insert(out, at, &piece);
        }
        7 => {
            let piece = piece(random, other);
            let n = piece.len().min(rest);
            out[at..at + n].copy_from_slice(&piece[..n]);
        }
        8 => overwrite(random, out, at),
        9 => insert(out, at, WORDS[below(random, WORDS.len())]),
        10 if !words.is_empty() => insert(out, at, words[below(random, words.len())]),
        11 | 12 => replace_word(random, out, at, words),
        13 => swap_lines(random, out),
        14 => out[at..at + length].fill(if random.below(2) == 0 { 0 } else { 0xff }),
        _ => {
            let line = line_at(out, at);
            let piece = out[line.clone()].to_vec();
            for _ in 0..1 << random.below(5) {
                insert(out, line.end, &piece);
            }
        }
    }
}

fn insert(out: &mut Vec<u8>, at: usize, piece: &[u8]) {
    drop(out.splice(at..at, piece.iter().copied()));
}

fn piece<'a>(random: &mut Random, other: &'a [u8]) -> &'a [u8] {
    let at = below(random, other.len());
    let length = length(random, 9);
    &other[at..other.len().min(at + length)]
}

/// Writes a number of one, two, four or eight bytes, in either order.
fn overwrite(random: &mut Random, out: &mut [u8], at: usize) {
    let (value, size) = (EDGES[below(random, EDGES.len())], 1 << random.below(4));
    let value = if random.below(4) == 0 { value.wrapping_sub(1) } else { value };
    let mut bytes = value.to_le_bytes()[..size].to_vec();
    if random.below(2) == 0 {
        bytes.reverse();
    }
    let n = size.min(out.len() - at);
    out[at..at + n].copy_from_slice(&bytes[..n]);
}

fn replace_word(random: &mut Random, out: &mut Vec<u8>, at: usize, words: &[&[u8]]) {
    let is_word = |b: &u8| !b.is_ascii_whitespace() && *b != b',';
    let start = out[..at].iter().rposition(|b| !is_word(b)).map_or(0, |i| i + 1);
    let end = out[at..].iter().position(|b| !is_word(b)).map_or(out.len(), |i| at + i);
    if start < end {
        let own = random.below(3) == 0 && !words.is_empty();
        let word = if own { words[below(random, words.len())] } else { WORDS[below(random, WORDS.len())] };
        drop(out.splice(start..end, word.iter().copied()));
    }
}

fn line_at(out: &[u8], at: usize) -> std::ops::Range<usize> {
    let start = out[..at].iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
    let end = out[at..].iter().position(|b| *b == b'\n').map_or(out.len(), |i| at + i + 1);
    start..end
}

fn swap_lines(random: &mut Random, out: &mut Vec<u8>) {
    let (a, b) = (below(random, out.len()), below(random, out.len()));
    let (a, b) = (line_at(out, a.min(b)), line_at(out, a.max(b)));
    if a.end <= b.start {
        let swapped =
            [&out[..a.start], &out[b.clone()], &out[a.end..b.start], &out[a], &out[b.end..]].concat();
        *out = swapped;
    }
}
