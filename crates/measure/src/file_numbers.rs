//! Numbers of facets in a file of which the reader left some out.

/// The facets that were left out: their numbers in the file, from 0 and ascending.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeftOut<'a>(pub &'a [u32]);

impl LeftOut<'_> {
    /// How many there are.
    pub fn count(self) -> u64 {
        self.0.len() as u64
    }

    /// The number in the file of the facet that is `facet` in the mesh.
    pub fn in_file(self, facet: u32) -> u32 {
        // Before the one with index `i` there are as many facets of the mesh as its number less `i`.
        let (mut low, mut high) = (0, self.0.len());
        while low < high {
            let middle = low + (high - low) / 2;
            match self.0[middle] - middle as u32 <= facet {
                true => low = middle + 1,
                false => high = middle,
            }
        }
        facet + low as u32
    }

    /// The number in the mesh of the facet that is `number` in the file, and was not left out.
    pub fn in_mesh(self, number: u32) -> u32 {
        number - self.0.partition_point(|left| *left < number) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_a_list_without_the_left_out() {
        for left in [&[][..], &[0], &[3], &[0, 1, 2], &[1, 3, 4, 9], &[9]] {
            let kept: Vec<u32> = (0..10).filter(|f| !left.contains(f)).collect();
            for (facet, number) in (0..).zip(kept) {
                assert_eq!((LeftOut(left).in_file(facet), LeftOut(left).in_mesh(number)), (number, facet));
            }
        }
    }
}
