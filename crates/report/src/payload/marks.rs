//! Marks as blobs: their places on a grid, and for each triangle, line and dot the number of its mark.

use super::super::marks::{Mark, MarkGroup, Marks};
use super::blob::ByteKind;
use super::contents::Payload;
use super::entry::{GroupEntry, MarksEntry};
use super::grid::Grid;
use super::planes::pack;
use trueness_document::scale::palette::hex;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::Aabb;

/// Packs marks as object `id`; their numbers begin at `first`.
pub fn pack_marks(part: &mut Payload, marks: &Marks, around: &Aabb, first: usize, id: usize) -> MarksEntry {
    let places = || marks.items().flat_map(Mark::places);
    let grid = Grid::over(&Aabb::of(places()).union(around), 16);
    // The first marks are drawn last, over the others.
    let mut last_first: Vec<(i32, &Mark)> = (0..).zip(marks.items()).collect();
    last_first.reverse();
    let items = || last_first.iter().map(|(_, m)| *m);
    // Areas first, then lines, then dots.
    let (t, s) = (
        items().flat_map(|m| m.triangles.iter().flatten()),
        items().flat_map(|m| m.segments.iter().flatten()),
    );
    let all: Vec<[u16; 3]> =
        t.chain(s).chain(items().flat_map(|m| &m.points)).map(|p| grid.place(p)).collect();
    let positions: Vec<u8> = (0..3)
        .flat_map(|k| {
            let at = |i: usize| i32::from(all[i][k]);
            pack((0..all.len()).into_par_iter().map(|i| at(i) - if i > 0 { at(i - 1) } else { 0 }), 2)
        })
        .collect();
    let counts: [fn(&Mark) -> usize; 3] = [|m| m.triangles.len(), |m| m.segments.len(), |m| m.points.len()];
    let numbers: Vec<i32> = counts
        .iter()
        .flat_map(|count| last_first.iter().flat_map(|(n, m)| std::iter::repeat_n(*n, count(m))))
        .collect();
    let steps =
        (0..numbers.len()).into_par_iter().map(|i| numbers[i] - if i > 0 { numbers[i - 1] } else { 0 });
    let numbers = pack(steps, 3);
    let total = |count: fn(&Mark) -> usize| marks.items().map(count).sum::<usize>();
    let group = |g: &MarkGroup| GroupEntry { key: g.key.clone(), color: hex(g.color), count: g.items.len() };
    MarksEntry {
        role: marks.role,
        kind: "marks",
        vertices: all.len(),
        origin: grid.origin,
        step: grid.step,
        shown: marks.shown(),
        comparison: marks.comparison,
        first,
        groups: marks.groups.iter().map(group).collect(),
        triangles: total(counts[0]),
        segments: total(counts[1]),
        points: total(counts[2]),
        positions: part.add(&positions, ByteKind::Differences),
        items: part.add(&numbers, ByteKind::Differences),
        id,
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::ViewRole;
    use super::*;

    #[test]
    fn counts_and_numbers_agree() {
        let mut facet = Mark::default();
        facet.add_facet([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let dot = Mark { points: vec![[0.5, 0.5, 7.0]], ..Mark::default() };
        let group = MarkGroup { key: "x".into(), color: [1, 2, 255], items: vec![facet, dot] };
        let marks = Marks { role: ViewRole::Defects, comparison: None, groups: vec![group] };
        let mut part = Payload::default();
        let entry = pack_marks(&mut part, &marks, &Aabb::of(&[[0.0; 3], [10.0; 3]]), 5, 2);
        assert_eq!([entry.triangles, entry.segments, entry.points], [1, 3, 1]);
        assert_eq!((entry.vertices, entry.first, entry.id), (3 + 6 + 1, 5, 2));
        assert_eq!(entry.groups, [GroupEntry { key: "x".into(), color: "0102ff".into(), count: 2 }]);
        assert_eq!(entry.step, 10.0 / 65_535.0);
        assert_eq!(part.blobs.len(), 2);
    }
}
