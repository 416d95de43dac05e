//! Points in a plane put in the order in which they follow each other along contours.
//!
//! Points scatter across a contour by more than they lie apart along it, so the nearest neighbor is not the next. The
//! points are gathered in square cells, made larger until the shortest tree over their middles hardly branches: then it
//! follows the contour. The longest way through the tree is the contour's course; branches beside it are put in where
//! they hang. Ways are linked over gaps that uneven points have by chance. A way along both faces of a thin wall is
//! parted in two. (After Lee, Curve reconstruction from unorganized points, Computer Aided Geometric Design 17, 2000;
//! cells in place of moving least squares.)

use super::cells::{Cells, MIN_CELLS_OF_WAY, Tree, tree_paths};
use super::gaps::{Limits, Linked, gap_to_close, link_over_gaps, longest_by_chance};
use super::untangle::untangle;
use super::walls::{Faces, Wall, faces};
use crate::model::flat::distance;
use trueness_geom::progress::{Cancelled, Progress};

/// Points that follow each other along one contour.
#[derive(Clone, Debug, PartialEq)]
pub struct Ordered {
    /// Their numbers, in order.
    pub numbers: Vec<usize>,
    /// Whether the last is near the first.
    pub closed: bool,
    /// Length of the way along which they were put in order, mm.
    pub way: f64,
    /// They may be of both faces of a wall, which is about this thick: too little for how the points scatter to tell them apart. `None` of
    /// points of one face.
    pub layered: Option<f64>,
}

/// The contours of points in a plane, and the gaps that they go on over.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Order {
    /// The contours: that of the most points first.
    pub rows: Vec<Ordered>,
    /// A contour goes on over gaps up to this, mm: the one given, or told from how uneven the points are. 0 where there are too
    /// few points to tell.
    pub gap: f64,
    /// Where contours are suspiciously many and open: the gap over which most of their ends would meet others, mm.
    pub wider: Option<f64>,
    /// The points lie all over an area, as those near a plane that lies in a face: there are no contours.
    pub fills_area: bool,
}

/// Share of branching cells up to which a tree follows a contour.
const MAX_BRANCHING_SHARE: f64 = 0.04;
/// A tree in more pieces than this share of its cells, and so many more, reaches too short for how uneven the points are.
const FRAGMENTED_SHARE_AND_COUNT: (f64, usize) = (0.03, 4);
/// A longer reach is worth it while it leaves no more than this share of the pieces.
const MAX_PIECES_RATIO: f64 = 0.7;
/// Cells grow by this factor, so many times at most.
const CELL_GROWTH_AND_TIMES: (f64, usize) = (1.4, 24);
/// A tree reaches over so many cells.
const TREE_REACH_CELLS: f64 = 4.0;
/// To the middle of the next cell, across a corner too, a tree reaches over so many.
const NEXT_CELL_REACH: f64 = 1.5;
/// The longest gap by chance is no larger than this share of all.
const MAX_GAP_OF_SIZE: f64 = 0.25;
/// Fewest points of a contour.
const MIN_POINTS_PER_CONTOUR: usize = 8;
/// So many open contours are suspicious where they are more than half of all.
const MIN_SUSPICIOUS_CONTOURS: usize = 6;

/// Contours of points in the plane, in any order.
///
/// A contour goes on over gaps up to `gap`. Where it is not given, it goes on over gaps that points so uneven have by
/// chance, and four cells at least. Points of no contour, fewer than eight together, are left out. Points all over an
/// area have none. Contours that touch each other are one with branches: the longest way is a contour, each of the rest
/// that is long enough another. Cost: the points' number times its logarithm.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
///
/// ```
/// use trueness_section::order;
/// let line: Vec<[f64; 2]> = (0..40).map(|i| [f64::from(i * 7 % 40), 0.0]).collect();
/// let found = order(&line, None, &trueness_geom::progress::Silent).unwrap().rows;
/// assert!(found.len() == 1 && !found[0].closed);
/// let along: Vec<f64> = found[0].numbers.iter().map(|i| line[*i][0]).collect();
/// assert!(along.is_sorted() || along.iter().rev().is_sorted());
/// ```
pub fn order(points: &[[f64; 2]], gap: Option<f64>, progress: &dyn Progress) -> Result<Order, Cancelled> {
    let n = points.len();
    let range = |k: usize| {
        points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p[k]), b.max(p[k])))
    };
    let size = libm::hypot(range(0).1 - range(0).0, range(1).1 - range(1).0);
    if n < MIN_POINTS_PER_CONTOUR || size <= 0.0 || !size.is_finite() {
        return Ok(Order { gap: gap.unwrap_or(0.0), ..Order::default() });
    }
    let Some(grown) = grow(points, 2.0 * size / n as f64, gap, progress)? else {
        return Ok(Order::default());
    };
    let finest = size / AREA_TEST_CELLS[1];
    if !(grown.follows && grown.cells.width < finest) && fills_area(points, size) {
        return Ok(Order { gap: gap.unwrap_or(0.0), fills_area: true, ..Order::default() });
    }
    let (width, levels) = if grown.follows {
        (grown.cells.width, FACE_SHARE_AND_GROWTHS.1)
    } else {
        (2.0 * size / n as f64, CELL_GROWTH_AND_TIMES.1)
    };
    let mut found = rows(points, grown, gap, size);
    let mut tried = parted(points, &mut found.0, gap, progress)?;
    // A tree whose cells are smaller than a wall is thick may run now along one face, now along the other. One of
    // larger cells runs along both, and its way is parted. Where no tree follows anything, that of any cells may.
    let mut wider_cells = width;
    let (mut layered, most) =
        (None, |r: &Ordered| r.numbers.len() as f64 >= FACE_SHARE_AND_GROWTHS.0 * n as f64);
    for _ in 0..levels {
        if tried {
            break;
        }
        wider_cells *= CELL_GROWTH_AND_TIMES.0;
        // Cells of this width reach over a gap that is given.
        if gap.is_some_and(|gap| NEXT_CELL_REACH * wider_cells > gap) {
            break;
        }
        let Some(cells) =
            Some(Cells::new(points, wider_cells)).filter(|c| c.middles.len() >= 2 * MIN_CELLS_OF_WAY)
        else {
            break;
        };
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let reach = gap.map_or(TREE_REACH_CELLS * wider_cells, |g| g.min(TREE_REACH_CELLS * wider_cells));
        let (tree, _) = cells.tree(reach);
        let mut other = rows(points, GrownTree { cells, tree, reach, follows: true }, gap, size);
        let is_parted = parted(points, &mut other.0, gap, progress)?;
        let better = ends(&other.0) < ends(&found.0) || is_mixed(&found.0, &other.0, n);
        if is_parted && better && count(&other.0) as f64 >= FACE_SHARE_AND_GROWTHS.0 * count(&found.0) as f64
        {
            (found, tried) = (other, true);
        } else if !is_parted {
            layered = layered.or(other.0.iter().filter(|r| most(r)).find_map(|r| r.layered));
        }
    }
    // Where a row runs along both faces of a wall in places, the smaller cells cannot have told them apart everywhere.
    if !tried {
        found.0.iter_mut().for_each(|row| row.layered = row.layered.or(layered));
    }
    let (mut rows, gap) = found;
    rows.retain(|r| r.numbers.len() >= MIN_POINTS_PER_CONTOUR);
    rows.sort_by_key(|r| std::cmp::Reverse(r.numbers.len()));
    for k in 1..rows.len() {
        rows[k].layered = rows[k].layered.or(distance_beside_longer(points, &rows, k, gap));
    }
    let wider = wider(points, &rows, gap);
    Ok(Order { rows, gap, wider, fills_area: false })
}

/// Cells in which it is told whether points fill an area have these shares of its size.
const AREA_TEST_CELLS: [f64; 2] = [8.0, 32.0];
/// In cells a quarter as wide a line fills 4 times as many, an area 16 times: between these.
const MIN_FILLED_RATIO: usize = 8;

/// Whether points lie all over an area, and not along lines, at scales well below its size.
fn fills_area(points: &[[f64; 2]], size: f64) -> bool {
    let [wide, narrow] = AREA_TEST_CELLS.map(|parts| Cells::new(points, size / parts).middles.len());
    points.len() >= 2 * narrow && narrow > MIN_FILLED_RATIO * wide
}

/// Cells grow so many times more where walls may be thin. The faces of a wall parted in two keep so large a share of its points.
const FACE_SHARE_AND_GROWTHS: (f64, usize) = (0.9, 6);

/// The rows along a tree, and the gap that they go on over.
fn rows(points: &[[f64; 2]], grown: GrownTree, gap: Option<f64>, size: f64) -> (Vec<Ordered>, f64) {
    let GrownTree { cells, tree, reach, follows } = grown;
    let ways = tree_paths(&cells, &tree);
    let gap = match (gap, follows) {
        (Some(gap), _) => gap.max(NEXT_CELL_REACH * cells.width),
        (None, true) => {
            let all = ways.iter().map(|way| cells.along(points, way, false).0);
            let steps = all.flat_map(|all| all.windows(2).map(|w| w[1].0 - w[0].0).collect::<Vec<f64>>());
            longest_by_chance(steps.collect(), reach).min((MAX_GAP_OF_SIZE * size).max(reach))
        }
        // A tree that branches everywhere follows no contour: nothing is known of its gaps.
        (None, false) => reach,
    };
    let limits = Limits { gap, closing: reach, fewest: 2 * MIN_CELLS_OF_WAY };
    let linked = link_over_gaps(ways, &cells.middles, &limits);
    (linked.iter().map(|way| row(&cells, points, way)).collect(), gap)
}

fn row(cells: &Cells, points: &[[f64; 2]], Linked { way, closed }: &Linked) -> Ordered {
    let (all, way) = cells.along(points, way, *closed);
    let mut numbers: Vec<usize> = all.into_iter().map(|(_, i)| i).collect();
    untangle(points, &mut numbers, *closed, way);
    Ordered { numbers, closed: *closed, way, layered: None }
}

fn count(rows: &[Ordered]) -> usize {
    rows.iter().map(|r| r.numbers.len()).sum()
}

/// Open ends of rows, and rows.
fn ends(rows: &[Ordered]) -> usize {
    let counted = rows.iter().filter(|r| r.numbers.len() >= MIN_POINTS_PER_CONTOUR);
    counted.map(|r| if r.closed { 1 } else { 3 }).sum()
}

/// Share of a row's points that others tell to be on another face, though they are not, as where these are torn.
const MIN_MIXED_SHARE: f64 = 0.15;

/// Whether a row runs along several faces that others of the `count` points tell apart.
fn is_mixed(rows: &[Ordered], faces: &[Ordered], count: usize) -> bool {
    let mut face_of = vec![None; count];
    for (k, face) in faces.iter().enumerate() {
        face.numbers.iter().for_each(|i| face_of[*i] = Some(k));
    }
    let mixed = |row: &Ordered| {
        let mut counts = vec![0; faces.len()];
        row.numbers.iter().filter_map(|i| face_of[*i]).for_each(|k| counts[k] += 1);
        let most = counts.iter().max().copied().unwrap_or(0);
        counts.iter().sum::<usize>() - most > (MIN_MIXED_SHARE * row.numbers.len() as f64).ceil() as usize
    };
    rows.iter().any(mixed)
}

/// A row along both faces of a wall, the wall, and the points of each face. These are the row's own, and those of
/// shorter rows beside it.
struct WallRow {
    row: Ordered,
    wall: Wall,
    own: [Vec<usize>; 2],
    seen_beside: [Vec<usize>; 2],
}

/// Parts rows along both faces of a wall in one for each face; whether there was one.
fn parted(
    points: &[[f64; 2]],
    rows: &mut Vec<Ordered>,
    gap: Option<f64>,
    progress: &dyn Progress,
) -> Result<bool, Cancelled> {
    let (mut walls, mut rest): (Vec<WallRow>, Vec<Ordered>) = (vec![], vec![]);
    let places = |row: &Ordered| row.numbers.iter().map(|i| points[*i]).collect::<Vec<_>>();
    for mut row in std::mem::take(rows) {
        match faces(&places(&row), row.closed) {
            Faces::One => rest.push(row),
            Faces::Unclear { apart } => {
                row.layered = Some(apart);
                rest.push(row);
            }
            Faces::Two { upper, unclear, wall } => {
                row.layered = unclear;
                let mut own = [vec![], vec![]];
                row.numbers.iter().zip(upper).for_each(|(i, u)| own[usize::from(u)].push(*i));
                walls.push(WallRow { row, wall, own, seen_beside: [vec![], vec![]] });
            }
        }
    }
    // Branches of the tree across the wall belong to its faces.
    for row in rest {
        let is_short =
            |w: &&mut WallRow| row.numbers.len() as f64 <= MAX_BRANCH_SHARE * w.row.numbers.len() as f64;
        let found =
            walls.iter_mut().filter(is_short).find_map(|w| Some((w.wall.faces_of(&places(&row))?, w)));
        match found {
            Some((upper, wall)) => {
                row.numbers.iter().zip(upper).for_each(|(i, u)| wall.seen_beside[usize::from(u)].push(*i));
            }
            None => rows.push(row),
        }
    }
    for wall in &walls {
        for side in [0, 1] {
            rows.push(face(points, wall, side, gap, progress)?);
        }
    }
    Ok(!walls.is_empty())
}

/// Rows of no more points than this share of a wall's may be branches of it.
const MAX_BRANCH_SHARE: f64 = 0.1;

/// The row of the points of one face of a wall: as they follow each other by themselves, or as they lay along the wall.
fn face(
    points: &[[f64; 2]],
    wall: &WallRow,
    side: usize,
    gap: Option<f64>,
    progress: &dyn Progress,
) -> Result<Ordered, Cancelled> {
    let numbers = [&wall.own[side][..], &wall.seen_beside[side]].concat();
    let own: Vec<[f64; 2]> = numbers.iter().map(|i| points[*i]).collect();
    let size = crate::row::clean::size(&own);
    let alone = match size > 0.0 {
        true => grow(&own, 2.0 * size / own.len() as f64, gap, progress)?,
        false => None,
    };
    let found = alone.map(|grown| rows(&own, grown, gap, size).0).unwrap_or_default();
    if let Some(one) = found.iter().max_by_key(|r| r.numbers.len())
        && one.numbers.len() as f64 >= FACE_SHARE_AND_GROWTHS.0 * own.len() as f64
        && one.closed == wall.row.closed
    {
        let numbers = one.numbers.iter().map(|k| numbers[*k]).collect();
        return Ok(Ordered { numbers, layered: wall.row.layered, ..one.clone() });
    }
    let mut numbers = wall.own[side].clone();
    untangle(points, &mut numbers, wall.row.closed, wall.row.way);
    Ok(Ordered { numbers, ..wall.row.clone() })
}

/// How far a short open row lies beside longer ones, where it does all along, no farther off than contours go on over.
/// It is then a piece of these, or of a face that was not told from them.
fn distance_beside_longer(points: &[[f64; 2]], rows: &[Ordered], k: usize, gap: f64) -> Option<f64> {
    let own = &rows[k];
    let short = MAX_BRANCH_SHARE * rows[0].numbers.len() as f64;
    if own.closed || own.numbers.len() as f64 > short || gap.is_nan() || gap <= 0.0 {
        return None;
    }
    let longer =
        rows[..k].iter().filter(|r| r.numbers.len() as f64 * MAX_BRANCH_SHARE >= own.numbers.len() as f64);
    let others: Vec<[f64; 2]> = longer.flat_map(|r| r.numbers.iter().map(|i| points[*i])).collect();
    let cells = Cells::new(&others, gap);
    let near =
        |i: &usize| cells.around(points[*i]).map(|j| distance(points[*i], others[j])).find(|d| *d <= gap);
    let all: Option<Vec<f64>> = own.numbers.iter().map(near).collect();
    all.map(|all| all.iter().sum::<f64>() / all.len() as f64)
}

/// The gap that would let most ends of open contours meet, where these are suspiciously many.
fn wider(points: &[[f64; 2]], rows: &[Ordered], gap: f64) -> Option<f64> {
    let open: Vec<&Ordered> = rows.iter().filter(|r| !r.closed).collect();
    if open.len() < MIN_SUSPICIOUS_CONTOURS || 2 * open.len() <= rows.len() {
        return None;
    }
    let ends = open.iter().flat_map(|r| [r.numbers[0], r.numbers[r.numbers.len() - 1]]);
    let ends: Vec<[f64; 2]> = ends.map(|i| points[i]).collect();
    gap_to_close(&ends, 2 * MIN_SUSPICIOUS_CONTOURS).map(|wider| wider.max(gap))
}

/// Cells of the width that was found, and the tree over them.
struct GrownTree {
    cells: Cells,
    tree: Tree,
    reach: f64,
    /// The tree hardly branches: it follows contours.
    follows: bool,
}

/// Cells made larger until the tree over them hardly branches, and as long as that leaves far fewer pieces.
fn grow(
    points: &[[f64; 2]],
    mut width: f64,
    gap: Option<f64>,
    progress: &dyn Progress,
) -> Result<Option<GrownTree>, Cancelled> {
    let mut best: Option<(GrownTree, usize)> = None;
    for _ in 0..CELL_GROWTH_AND_TIMES.1 {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let cells = Cells::new(points, width);
        let reach = gap.map_or(TREE_REACH_CELLS * width, |g| {
            g.min(TREE_REACH_CELLS * width).max(NEXT_CELL_REACH * width)
        });
        let (tree, choices) = cells.tree(reach);
        let n = cells.middles.len();
        // A tree that does not branch is no contour's, where another one as short would.
        let branching = choices.iter().filter(|edges| **edges > 2).count() as f64;
        let lonely = tree.iter().filter(|near| near.is_empty()).count() as f64;
        let pieces = n - tree.iter().map(Vec::len).sum::<usize>() / 2;
        let enough = n >= 2 * MIN_CELLS_OF_WAY;
        let follows = (branching + lonely) / n as f64 <= MAX_BRANCHING_SHARE;
        if best.is_some() && !enough {
            break;
        }
        if let Some((_, before)) = best.as_ref().filter(|(b, _)| b.follows)
            && (!follows || pieces as f64 > MAX_PIECES_RATIO * *before as f64)
        {
            break;
        }
        let fragmented = gap.is_none()
            && pieces as f64 > FRAGMENTED_SHARE_AND_COUNT.0 * n as f64 + FRAGMENTED_SHARE_AND_COUNT.1 as f64;
        best = Some((GrownTree { cells, tree, reach, follows }, pieces));
        if follows && !fragmented {
            break;
        }
        width *= CELL_GROWTH_AND_TIMES.0;
    }
    Ok(best.map(|(grown, _)| grown))
}
