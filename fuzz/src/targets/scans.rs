//! The readers of scanners' formats.

use super::readers::both;
use super::{Target, files};
use crate::mutate::mutated;
use trueness_files::Format;

/// PCD in text, bytes and packed.
pub const PCD: Target = Target {
    name: "pcd",
    extension: "pcd",
    seeds: |corpus| files(corpus, &["pcd"]),
    mutate: |random, case, other| mutated(random, case, other, PCD_WORDS),
    run: |_, path| both(path, Format::named("pcd")),
    size: <[u8]>::len,
};

const PCD_WORDS: &[&[u8]] = &[
    b"FIELDS x y z\n",
    b"SIZE 8 8 8\n",
    b"TYPE F I U\n",
    b"COUNT 1 1 1\n",
    b"WIDTH 3\n",
    b"HEIGHT 1\n",
    b"POINTS 3\n",
    b"VIEWPOINT 0 0 0 1 0 0 0\n",
    b"DATA ascii\n",
    b"DATA binary\n",
    b"DATA binary_compressed\n",
];

/// PTX.
pub const PTX: Target = Target {
    name: "ptx",
    extension: "ptx",
    seeds: |corpus| files(corpus, &["ptx"]),
    mutate: |random, case, other| mutated(random, case, other, &[b"0 0 0 0.5\n", b"0 0 0 1\n", b"1 0 0\n"]),
    run: |_, path| both(path, Format::named("ptx")),
    size: <[u8]>::len,
};

/// LAS, LAZ and COPC.
pub const LAS: Target = Target {
    name: "las",
    extension: "las",
    seeds: |corpus| files(corpus, &["las", "laz"]),
    mutate: |random, case, other| {
        mutated(
            random,
            case,
            other,
            &[b"LASF_Projection", b"laszip encoded", b"UNIT[\"metre\",1]", b"PROJCS["],
        )
    },
    run: |_, path| both(path, Format::named("las")),
    size: <[u8]>::len,
};

/// E57, with the checksums set right behind the changes.
pub const E57: Target = Target {
    name: "e57",
    extension: "e57",
    seeds: |corpus| files(corpus, &["e57"]),
    mutate: |random, case, other| {
        let mut case = mutated(random, case, other, E57_WORDS);
        case.chunks_exact_mut(PAGE_BYTES).for_each(set_checksum);
        case
    },
    run: |_, path| both(path, Format::named("e57")),
    size: <[u8]>::len,
};

const E57_WORDS: &[&[u8]] = &[
    b"<cartesianX type=\"Float\"/>",
    b"type=\"ScaledInteger\"",
    b"minimum=\"-9223372036854775808\"",
    b"maximum=\"0\"",
    b"recordCount=\"1\"",
    b"fileOffset=\"48\"",
    b"precision=\"single\"",
    b"sphericalRange",
];
const PAGE_BYTES: usize = 1024;

/// CRC-32C of a page, at its end.
fn set_checksum(page: &mut [u8]) {
    let (content, checksum) = page.split_at_mut(PAGE_BYTES - 4);
    let mut crc = !0u32;
    for byte in content {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = crc >> 1 ^ if crc & 1 == 1 { 0x82f6_3b78 } else { 0 };
        }
    }
    checksum.copy_from_slice(&(!crc).to_be_bytes());
}
