//! LZF: literal runs and references to what came before (Marc Lehmann, LibLZF).

/// Every byte that is read stands for at most this many: a reference of three bytes for 264.
pub(super) const MAX_LZF_RATIO: u64 = 88;
/// Control bytes below this begin a run of so many literal bytes, and one more.
const FIRST_REFERENCE: u8 = 32;
/// A length in a control byte that is continued in the next byte.
const LONG_LENGTH: usize = 7;

/// Unpacks `packed` to exactly `length` bytes; `None` where it does not.
pub(super) fn unpack(packed: &[u8], length: usize) -> Option<Vec<u8>> {
    let mut out = Vec::new();
    out.try_reserve_exact(length).ok()?;
    let mut rest = packed;
    while let [control, later @ ..] = rest {
        rest = later;
        if *control < FIRST_REFERENCE {
            let (run, later) = rest.split_at_checked(usize::from(*control) + 1)?;
            out.extend_from_slice(run);
            rest = later;
        } else {
            let mut count = usize::from(control >> 5);
            if count == LONG_LENGTH {
                let (more, later) = rest.split_first()?;
                count += usize::from(*more);
                rest = later;
            }
            let (low, later) = rest.split_first()?;
            rest = later;
            let back = (usize::from(control & 31) << 8 | usize::from(*low)) + 1;
            let start = out.len().checked_sub(back)?;
            // What is copied may reach into what it makes.
            (start..start + count + 2).for_each(|i| out.push(out[i]));
        }
        if out.len() > length {
            return None;
        }
    }
    (out.len() == length).then_some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_and_references_of_every_length() {
        assert_eq!(unpack(&[2, b'a', b'b', b'c'], 3).unwrap(), b"abc");
        // Three letters, then six from three back: they reach into themselves.
        assert_eq!(unpack(&[2, b'a', b'b', b'c', 4 << 5, 2], 9).unwrap(), b"abcabcabc");
        // One letter and 264 more of it.
        assert_eq!(unpack(&[0, b'x', 7 << 5, 255, 0], 265).unwrap(), vec![b'x'; 265]);
        assert_eq!(unpack(&[], 0).unwrap(), b"");
    }

    #[test]
    fn damaged_bytes_are_no_data() {
        for (packed, length) in [
            (&[2, b'a'][..], 3),
            (&[0, b'a', 1 << 5, 1], 4),
            (&[0, b'a', 7 << 5], 10),
            (&[0, b'a', 1 << 5], 4),
            (&[2, b'a', b'b', b'c'], 2),
            (&[2, b'a', b'b', b'c'], 4),
            (&[32, 0], 3),
        ] {
            assert_eq!(unpack(packed, length), None, "{packed:?}");
        }
    }
}
