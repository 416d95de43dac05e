//! What the next vertex of a mesh probably looks like, from those that the reader has already.
//!
//! Vertices stand in the order in which the triangles first use them. Reader and writer walk the same triangles, so both know
//! the corners beside a new vertex, and often the triangle across the shared edge: the parallelogram rule of C. Touma and
//! C. Gotsman, "Triangle mesh compression", Graphics Interface 1998.

/// How a vertex is predicted from earlier ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// From nothing.
    Zero,
    /// As vertex `a`.
    Like(u32),
    /// Halfway between `a` and `b`.
    Between(u32, u32),
    /// `a + b - c`: the fourth corner of a parallelogram, `c` across the edge from `a` to `b`.
    Across(u32, u32, u32),
}

/// Triangles looked back through for the neighbor across an edge.
const MAX_TRIANGLES_BACK: usize = 16;

/// One rule a vertex. `triangles` name the vertices in order of first use; every one of `vertices` is used.
pub fn rules(triangles: &[[u32; 3]], vertices: usize) -> Vec<Rule> {
    let mut rules = Vec::with_capacity(vertices);
    for (t, corners) in triangles.iter().enumerate() {
        let mut fresh: Vec<u32> = corners.iter().copied().filter(|c| *c as usize >= rules.len()).collect();
        fresh.sort_unstable();
        fresh.dedup();
        for vertex in fresh {
            let mut known = corners.iter().copied().filter(|c| *c < vertex);
            rules.push(match (known.next(), known.next()) {
                (Some(a), Some(b)) => match across(&triangles[t.saturating_sub(MAX_TRIANGLES_BACK)..t], a, b)
                {
                    Some(c) => Rule::Across(a, b, c),
                    None => Rule::Between(a, b),
                },
                (Some(a), None) => Rule::Like(a),
                _ => vertex.checked_sub(1).map_or(Rule::Zero, Rule::Like),
            });
        }
    }
    rules
}

/// Third corner of the latest of `earlier` that has both `a` and `b`.
fn across(earlier: &[[u32; 3]], a: u32, b: u32) -> Option<u32> {
    let other = |t: &[u32; 3]| t.iter().copied().find(|c| *c != a && *c != b);
    earlier.iter().rev().find(|t| t.contains(&a) && t.contains(&b)).and_then(other)
}

impl Rule {
    /// The prediction for positions, coordinate by coordinate.
    pub fn position(self, known: impl Fn(u32) -> i32) -> i32 {
        match self {
            Rule::Across(a, b, c) => known(a) + known(b) - known(c),
            other => other.value(known),
        }
    }

    /// The prediction for values on the surface: halfway between the known corners.
    pub fn value(self, known: impl Fn(u32) -> i32) -> i32 {
        match self {
            Rule::Zero => 0,
            Rule::Like(a) => known(a),
            Rule::Between(a, b) | Rule::Across(a, b, _) => (known(a) + known(b)) >> 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_is_predicted_across_its_edges() {
        let rules = rules(&[[0, 1, 2], [2, 1, 3], [2, 3, 4], [5, 6, 7]], 8);
        assert_eq!(
            rules,
            [
                Rule::Zero,
                Rule::Like(0),
                Rule::Between(0, 1),
                Rule::Across(2, 1, 0),
                Rule::Across(2, 3, 1),
                Rule::Like(4),
                Rule::Like(5),
                Rule::Between(5, 6)
            ]
        );
        let x = [0, 10, 0, 10, 1];
        assert_eq!(rules[3].position(|v| x[v as usize]), 10);
        assert_eq!(rules[4].value(|v| x[v as usize]), 5);
    }

    #[test]
    fn a_turned_triangle_still_meets_its_new_vertices_in_order() {
        assert_eq!(rules(&[[1, 2, 0], [4, 0, 3]], 5)[3..], [Rule::Like(0), Rule::Between(0, 3)]);
    }
}
