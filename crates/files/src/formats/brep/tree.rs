//! Where parts stand: all ways from the roots of the assembly down to them.
//!
//! How many there are is counted before any is made: each level may double them.

use crate::error::{Fault, Result};
use trueness_cad::brep::Color;
use trueness_cad::frame::Placement;
use trueness_cad::model::Instance;

/// Names on all ways from a root to an instance, together.
const MAX_NAMES_OF_WAYS: u64 = 1 << 22;
/// Faces of all instances.
const MAX_FACES: u64 = 1 << 22;

/// What stands below each node.
#[derive(Clone, Copy, Default)]
struct Below {
    instances: u64,
    names: u64,
    faces: u64,
    levels: u32,
}

/// A part or an assembly.
#[derive(Default)]
pub(crate) struct Node {
    pub name: String,
    pub children: Vec<Child>,
}

/// A node as it stands in another one.
pub(crate) struct Child {
    pub node: usize,
    pub name: String,
    pub placement: Placement,
    /// The entity that places it.
    pub entity: u64,
    /// What a file styles where it gives this occurrence a color.
    pub styled: u64,
    /// Whether it stands in itself, and is left out.
    pub is_cut: bool,
}

/// How the parts of an assembly stand.
pub(crate) struct Instances {
    pub instances: Vec<Instance>,
    /// Levels of the assembly.
    pub levels: u32,
    /// Entities that place a node in itself, with its name there: they are left out.
    pub cut: Vec<(u64, String)>,
}

/// The instances of an assembly, with the color that each has itself, and the number of its levels. `parts` has the part of each
/// node with its number of faces, if it has one.
pub(crate) fn instances(
    nodes: &mut [Node],
    parts: &[Option<(u32, u64)>],
    color: impl Fn(u64) -> Option<Color>,
) -> Result<Instances> {
    let (order, roots, cut) = ordered(nodes);
    let below = count(nodes, parts, &order);
    let sum = |of: fn(&Below) -> u64| roots.iter().map(|r| of(&below[*r])).fold(0, u64::saturating_add);
    let limits = [
        ("instances of parts", sum(|b| b.instances), sum(|b| b.names), MAX_NAMES_OF_WAYS),
        ("faces of all instances", sum(|b| b.faces), sum(|b| b.faces), MAX_FACES),
    ];
    for (what, count, weighed, limit) in limits {
        if weighed > limit {
            return Err(Fault::TooMany { what, count, limit }.into());
        }
    }
    let levels = roots.iter().map(|r| below[*r].levels).max().unwrap_or_default();
    Ok(Instances { instances: expanded(nodes, parts, &roots, &below, color), levels, cut })
}

/// Nodes with those that stand in them first, the roots, and what was cut where nodes stand in themselves.
type Order = (Vec<usize>, Vec<usize>, Vec<(u64, String)>);

fn ordered(nodes: &mut [Node]) -> Order {
    let mut is_child = vec![false; nodes.len()];
    for node in nodes.iter() {
        node.children.iter().for_each(|c| is_child[c.node] = true);
    }
    // Those that stand in no other one begin; then what only circles lead to.
    let starts = (0..nodes.len()).filter(|n| !is_child[*n]).chain((0..nodes.len()).filter(|n| is_child[*n]));
    let starts: Vec<usize> = starts.collect();
    let (mut state, mut order, mut roots, mut cut) = (vec![State::New; nodes.len()], vec![], vec![], vec![]);
    for start in starts {
        if state[start] != State::New {
            continue;
        }
        roots.push(start);
        state[start] = State::Open;
        let mut way = vec![(start, 0)];
        while let Some((node, next)) = way.pop() {
            let Some(child) = nodes[node].children.get(next).map(|c| c.node) else {
                state[node] = State::Done;
                order.push(node);
                continue;
            };
            match state[child] {
                State::Open => {
                    let child = &mut nodes[node].children[next];
                    child.is_cut = true;
                    cut.push((child.entity, child.name.clone()));
                    way.push((node, next + 1));
                }
                State::Done => way.push((node, next + 1)),
                State::New => {
                    state[child] = State::Open;
                    way.push((node, next + 1));
                    way.push((child, 0));
                }
            }
        }
    }
    (order, roots, cut)
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Open,
    Done,
}

fn count(nodes: &[Node], parts: &[Option<(u32, u64)>], order: &[usize]) -> Vec<Below> {
    let mut below = vec![Below::default(); nodes.len()];
    for node in order {
        let own = parts.get(*node).copied().flatten();
        let mut sum = match own {
            Some((_, faces)) => Below { instances: 1, names: 1, faces, levels: 0 },
            None => Below::default(),
        };
        for child in nodes[*node].children.iter().filter(|c| !c.is_cut) {
            let inner = below[child.node];
            if inner.instances > 0 {
                sum.instances = sum.instances.saturating_add(inner.instances);
                sum.names = sum.names.saturating_add(inner.names).saturating_add(inner.instances);
                sum.faces = sum.faces.saturating_add(inner.faces);
                sum.levels = sum.levels.max(inner.levels + 1);
            }
        }
        below[*node] = sum;
    }
    below
}

fn expanded(
    nodes: &[Node],
    parts: &[Option<(u32, u64)>],
    roots: &[usize],
    below: &[Below],
    color: impl Fn(u64) -> Option<Color>,
) -> Vec<Instance> {
    let mut all = vec![];
    let mut path: Vec<String> = vec![];
    for root in roots.iter().filter(|r| below[**r].instances > 0) {
        // Depth of the node, its name, and how it stands.
        let mut pending = vec![(0, *root, nodes[*root].name.clone(), Placement::IDENTITY, None)];
        while let Some((depth, node, name, placement, own)) = pending.pop() {
            path.truncate(depth);
            path.push(name);
            if let Some((part, _)) = parts.get(node).copied().flatten() {
                all.push(Instance { part, path: path.clone(), placement, color: own });
            }
            let children = nodes[node].children.iter().filter(|c| !c.is_cut && below[c.node].instances > 0);
            pending.extend(children.rev().map(|c| {
                let placed = placement.after(&c.placement);
                (depth + 1, c.node, c.name.clone(), placed, color(c.styled).or(own))
            }));
        }
    }
    all
}
