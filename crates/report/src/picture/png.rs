//! PNG (RFC 2083), true color with opacity, eight bits.

use super::super::payload::zlib;
use zlib_rs::crc32::crc32;

/// Encodes `width` × `height` pixels of red, green, blue, opacity, row by row from the top.
pub fn encode(width: u32, height: u32, pixels: &[[u8; 4]]) -> Vec<u8> {
    let mut rows = Vec::with_capacity(pixels.len() * 4 + height as usize);
    let mut above = vec![[0; 4]; width as usize];
    for row in pixels.chunks_exact(width.max(1) as usize) {
        // Filter 2: the difference from the pixel above.
        rows.push(2);
        rows.extend(row.iter().zip(&above).flat_map(|(p, a)| [0, 1, 2, 3].map(|k| p[k].wrapping_sub(a[k]))));
        above.copy_from_slice(row);
    }
    let packed = zlib(&rows);
    let mut header = [width.to_be_bytes(), height.to_be_bytes()].concat();
    header.extend([8, 6, 0, 0, 0]);
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in [(b"IHDR", &header), (b"IDAT", &packed), (b"IEND", &vec![])] {
        chunk(&mut file, kind, data);
    }
    file
}

fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    file.extend((data.len() as u32).to_be_bytes());
    file.extend(kind);
    file.extend(data);
    file.extend(crc32(crc32(0, kind), data).to_be_bytes());
}
