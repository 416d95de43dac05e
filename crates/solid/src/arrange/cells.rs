//! The cells that the pieces divide space into, and how often the surface winds around each.
//!
//! Each piece has two sides. Around an edge, the side of a piece and the facing side of the next one belong to one
//! cell. Passing through a piece changes the winding number by its jump, so all cells that hang together follow from
//! one. (Zhou et al., Mesh Arrangements for Solid Geometry, 2016). A ray is counted for that one (see `ray`).

use super::cut::Piece;
use super::edge_order::{self, Side};
use super::points::Points;
use super::ray::{Rays, ShellWindings};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::topology::sides::{self, each_edge};
use trueness_geom::topology::union::Sets;

/// The number of a part, the number to add to the winding numbers relative to its first cell, and the shells around it.
type Anchored = (usize, i32, ShellWindings);

/// A step from one cell to another: both cells, the change of the winding number, and a piece that makes it.
type Step = ([u32; 2], i32, u32);

/// Pieces of one task.
const PIECES_PER_TASK: usize = 1 << 13;

/// Winding numbers on the two sides of each piece.
pub(super) struct Windings {
    /// Where it looks to, and where it comes from.
    pub sides: Vec<[i32; 2]>,
}

/// Why there are none: a piece near which the surface is not closed, or contradicts itself.
pub(super) struct Open(pub usize);

/// The winding numbers beside the pieces with a jump;
/// `shell_of` gives the shell of each facet of the mesh. With `turn`, parts of the surface that wind around nothing in
/// the positive sense are taken the other way round.
pub(super) fn windings(
    mesh: &Mesh,
    points: &Points,
    pieces: &[Piece],
    shell_of: &[u32],
    turn: bool,
) -> Result<Windings, Open> {
    let sets = joined(mesh, points, pieces)?;
    let (cells, cell_of) = sets.numbered(|_| true);
    let cell = |piece: usize| [cell_of[2 * piece], cell_of[2 * piece + 1]];
    // Steps between cells, each with the first piece that makes it. Neighbors in the list mostly make the same.
    let step = |p: usize| (cell(p), pieces[p].jump, p as u32);
    let steps_of = |part: usize| {
        let mut steps: Vec<Step> =
            (part * PIECES_PER_TASK..pieces.len().min((part + 1) * PIECES_PER_TASK)).map(step).collect();
        steps.dedup_by_key(|s| (s.0, s.1));
        steps
    };
    let mut steps: Vec<Step> =
        (0..pieces.len().div_ceil(PIECES_PER_TASK)).into_par_iter().flat_map_iter(steps_of).collect();
    steps.par_sort_unstable();
    steps.dedup_by_key(|s| (s.0, s.1));
    let relative = relative(cells, &steps)?;
    let parts = Sets::new(cells);
    steps.iter().for_each(|([f, b], ..)| parts.join(*f, *b));
    let (count, part_of) = parts.numbered(|_| true);
    let part = |piece: usize| part_of[cell(piece)[0] as usize] as usize;
    let rays = Rays::new(mesh, shell_of, points);
    let mut of_part: Vec<Vec<u32>> = vec![vec![]; count];
    (0..pieces.len()).for_each(|p| of_part[part(p)].push(p as u32));
    let counted = rays.count(pieces, &of_part).map_err(|part| Open(of_part[part][0] as usize))?;
    let anchored = |(number, (piece, side, around)): (usize, (usize, usize, ShellWindings))| {
        let winding: i32 = around.iter().map(|a| a.1).sum();
        (number, winding - relative[cell(piece)[side] as usize], around)
    };
    let absolute: Vec<Anchored> = counted.into_iter().enumerate().map(anchored).collect();
    let sign = match turn {
        true => signs(pieces, shell_of, &of_part, &absolute, |p| cell(p).map(|c| relative[c as usize])),
        false => vec![1; count],
    };
    let of = |p: usize| {
        let part = part(p);
        cell(p).map(|c| sign[part] * (relative[c as usize] + absolute[part].1))
    };
    Ok(Windings { sides: (0..pieces.len()).into_par_iter().map(of).collect() })
}

/// Joins the sides of pieces that face each other around an edge: side `2 p` is where piece `p` looks to.
fn joined(mesh: &Mesh, points: &Points, pieces: &[Piece]) -> Result<Sets, Open> {
    let sets = Sets::new(2 * pieces.len());
    let faces: Vec<[u32; 3]> = pieces.par_iter().map(|p| p.corners).collect();
    each_edge(points.len(), &faces, |edge| {
        let mut around: Vec<Side>;
        let side = |s: &sides::Side| Side {
            ends: s.ends,
            piece: s.facet,
            facet: pieces[s.facet as usize].facet,
            up: s.up,
        };
        let around = match edge {
            [s, t] => &[side(s), side(t)][..],
            _ => {
                around = edge.iter().map(side).collect();
                edge_order::sort(mesh, points, &mut around).ok_or(Open(edge[0].facet as usize))?;
                &around[..]
            }
        };
        for (i, s) in around.iter().enumerate() {
            let t = &around[(i + 1) % around.len()];
            sets.join(2 * s.piece + u32::from(!s.up), 2 * t.piece + u32::from(t.up));
        }
        Ok(())
    })?;
    Ok(sets)
}

/// Winding numbers of all cells, that of one cell of each part being 0.
fn relative(cells: usize, steps: &[Step]) -> Result<Vec<i32>, Open> {
    let mut across: Vec<(u32, u32, i32)> = steps
        .iter()
        .flat_map(|([front, back], jump, _)| [(*front, *back, *jump), (*back, *front, -jump)])
        .collect();
    across.sort_unstable();
    let mut number: Vec<Option<i32>> = vec![None; cells];
    for first in 0..cells as u32 {
        let mut stack = vec![];
        if number[first as usize].is_none() {
            number[first as usize] = Some(0);
            stack.push(first);
        }
        while let Some(cell) = stack.pop() {
            let own = number[cell as usize].unwrap_or(0);
            let from = across.partition_point(|a| a.0 < cell);
            for (_, other, jump) in across[from..].iter().take_while(|a| a.0 == cell) {
                if number[*other as usize].is_none() {
                    number[*other as usize] = Some(own + jump);
                    stack.push(*other);
                }
            }
        }
    }
    let number: Vec<i32> = number.into_iter().map(|n| n.unwrap_or(0)).collect();
    let wrong = |([f, b], jump, _): &&Step| number[*b as usize] != number[*f as usize] + jump;
    match steps.iter().find(wrong) {
        Some((.., piece)) => Err(Open(*piece as usize)),
        None => Ok(number),
    }
}

/// For each part 1, or −1 where it belongs to shells that together wind around nothing in the positive sense. Shells belong
/// together if they meet, or if one winds around the other.
fn signs(
    pieces: &[Piece],
    shell_of: &[u32],
    of_part: &[Vec<u32>],
    absolute: &[Anchored],
    relative: impl Fn(usize) -> [i32; 2],
) -> Vec<i32> {
    let shells = shell_of.iter().filter(|s| **s != u32::MAX).max().map_or(0, |s| *s as usize + 1);
    let groups = Sets::new(shells);
    let shell = |piece: u32| shell_of[pieces[piece as usize].facet as usize];
    for (part, _, around) in absolute {
        let own = shell(of_part[*part][0]);
        of_part[*part].iter().for_each(|p| groups.join(own, shell(*p)));
        around.iter().filter(|a| a.1 != 0).for_each(|a| groups.join(own, a.0));
    }
    let mut most = vec![0; shells];
    let group = |part: usize| groups.root(shell(of_part[part][0])) as usize;
    for (part, offset, _) in absolute {
        let highest = of_part[*part].iter().flat_map(|p| relative(*p as usize)).max().unwrap_or(0) + offset;
        let most = &mut most[group(*part)];
        *most = highest.max(*most);
    }
    absolute.iter().map(|(part, ..)| if most[group(*part)] > 0 { 1 } else { -1 }).collect()
}
