//! Bytes on their way into the page: gzip without time or name, then base64. The same bytes every time.

use zlib_rs::{DeflateConfig, Strategy, compress_bound, compress_slice};

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
/// What deflate says for the longest window, and that the frame be gzip's (RFC 1952).
const GZIP_WINDOW: i32 = 15 + 16;
/// Bytes that the frame takes.
const FRAME_BYTES: usize = 64;

/// What bytes are like, which decides where deflate looks for repetitions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ByteKind {
    /// Differences from a prediction: noise and runs of one value. Looking for anything but runs takes thirty times as long and
    /// makes more bytes.
    Differences,
    /// Codes in which the same sequences come again.
    Code,
}

/// Gzip of `bytes`. There is room for whatever comes out; if there was not the blob would be empty, which the page reports.
pub fn gzip(bytes: &[u8], kind: ByteKind) -> Vec<u8> {
    let strategy = if kind == ByteKind::Differences { Strategy::Rle } else { Strategy::Default };
    packed(bytes, DeflateConfig { window_bits: GZIP_WINDOW, strategy, ..DeflateConfig::new(6) })
}

/// Zlib stream (RFC 1950) of `bytes`.
pub fn zlib(bytes: &[u8]) -> Vec<u8> {
    packed(bytes, DeflateConfig::new(6))
}

fn packed(bytes: &[u8], config: DeflateConfig) -> Vec<u8> {
    let mut room = vec![0; compress_bound(bytes.len()) + FRAME_BYTES];
    let (out, code) = compress_slice(&mut room, bytes, config);
    // 0 is what zlib calls OK.
    let length = if code as i32 == 0 { out.len() } else { 0 };
    room.truncate(length);
    room
}

/// Base64 with padding (RFC 4648).
pub fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let group = chunk.iter().fold(0, |g, b| g << 8 | u32::from(*b)) << (8 * (3 - chunk.len()));
        for k in 0..4 {
            let digit = DIGITS[(group >> (18 - 6 * k)) as usize & 63];
            text.push(if k <= chunk.len() { digit as char } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn base64_as_in_the_standard() {
        for (plain, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
        ] {
            assert_eq!(base64(plain.as_bytes()), text);
        }
    }

    #[test]
    fn gzip_has_no_time_and_comes_back() {
        let bytes: Vec<u8> = (0..10_000u32).map(|i| (i * i % 251) as u8).collect();
        for kind in [ByteKind::Differences, ByteKind::Code] {
            let packed = gzip(&bytes, kind);
            assert_eq!(packed[4..8], [0; 4]);
            let mut back = vec![];
            flate2::read::GzDecoder::new(&packed[..]).read_to_end(&mut back).unwrap();
            assert_eq!(back, bytes);
        }
        let mut back = vec![];
        flate2::read::ZlibDecoder::new(&zlib(&bytes)[..]).read_to_end(&mut back).unwrap();
        assert_eq!(back, bytes);
    }
}
