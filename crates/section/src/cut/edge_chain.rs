//! Steps from edge to edge, put together into chains.

/// An edge by its vertices, the lower first.
pub(super) type Edge = [u32; 2];

/// A chain of edges.
pub(super) struct EdgeChain {
    /// The edges in their order.
    pub edges: Vec<Edge>,
    /// Whether the last leads to the first.
    pub closed: bool,
}

/// No step begins at the edge.
const NO_STEP: u32 = u32::MAX;

/// The chains that steps from one edge to another make, each step in one of them. Where several begin at the same edge, they are
/// taken in the order of the list. Open chains come first, each from an edge where no step ends.
///
/// Cost: as sorting the steps, whatever their edges.
pub(super) fn edge_chains(steps: &[[Edge; 2]]) -> Vec<EdgeChain> {
    // The steps by the edge where they begin, those of one edge in their order.
    let mut by_start: Vec<(Edge, u32)> = steps.iter().zip(0..).map(|(step, n)| (step[0], n)).collect();
    by_start.sort_unstable();
    // Edges where steps begin, as runs of that list: the next step to take and the end of the run.
    let mut runs: Vec<[u32; 2]> = vec![];
    let mut start_run = vec![0; steps.len()];
    for (at, (edge, n)) in by_start.iter().enumerate() {
        if at == 0 || by_start[at - 1].0 != *edge {
            runs.push([at as u32, at as u32]);
        }
        if let Some(run) = runs.last_mut() {
            run[1] += 1;
        }
        start_run[*n as usize] = runs.len() as u32 - 1;
    }
    // For each step the run where it ends; for each run whether a step ends there.
    let mut by_end: Vec<(Edge, u32)> = steps.iter().zip(0..).map(|(step, n)| (step[1], n)).collect();
    by_end.sort_unstable();
    let mut end_run = vec![NO_STEP; steps.len()];
    let mut arrived = vec![false; runs.len()];
    let mut run = 0;
    for (edge, n) in by_end {
        while run < runs.len() && by_start[runs[run][0] as usize].0 < edge {
            run += 1;
        }
        if run < runs.len() && by_start[runs[run][0] as usize].0 == edge {
            end_run[n as usize] = run as u32;
            arrived[run] = true;
        }
    }
    let mut chains = vec![];
    for closed in [false, true] {
        for first in 0..steps.len() {
            let run = start_run[first];
            if !closed && arrived[run as usize] {
                continue;
            }
            while runs[run as usize][0] < runs[run as usize][1] {
                chains.push(follow(steps, &by_start, &mut runs, &end_run, run));
            }
        }
    }
    chains
}

/// Takes steps from an edge on until the chain ends or comes back.
fn follow(
    steps: &[[Edge; 2]],
    by_start: &[(Edge, u32)],
    runs: &mut [[u32; 2]],
    end_run: &[u32],
    first: u32,
) -> EdgeChain {
    let mut edges = vec![by_start[runs[first as usize][0] as usize].0];
    let mut now = first;
    while now != NO_STEP && runs[now as usize][0] < runs[now as usize][1] {
        let step = by_start[runs[now as usize][0] as usize].1 as usize;
        runs[now as usize][0] += 1;
        now = end_run[step];
        if now == first {
            return EdgeChain { edges, closed: true };
        }
        edges.push(steps[step][1]);
    }
    EdgeChain { edges, closed: false }
}
