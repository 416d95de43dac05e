//! Faces in the parameters of their surfaces: what of a surface is inside the loops of its edges.
//!
//! Files give edges in space; their parameters are those of the nearest places on the surface. Loops of a surface that closes may go
//! around it, so a face is cut open (`open`) until all its rings are closed in the plane of the parameters, with the face on
//! their left. What lies inside then is what the rings wind around, and an integral over the face is one along the rings.
//!
//! Nothing is taken from the order of loops, from seams or from what the file calls outer; all follows from the direction of the edges. Loops
//! that contradict each other are an error, and so are edges that are far from the surface.

mod chain;
mod chart;
mod cut;
mod error;
mod open;
mod outline;
mod ring;
mod senses;
mod strand;
#[cfg(test)]
pub(crate) mod tests;

pub use chart::{Chart, Side};
pub use error::TrimError;
pub use ring::{Piece, Ring, Straight};
pub use strand::{Sample, Strand, crossing};

use crate::brep::{Bounds, Brep, EdgeUse, Face, Loop};
use crate::curve::Span;
use chart::SAME_PARAMETER;
use outline::{Outline, PieceId};
use trueness_geom::space::{Aabb, Point};

/// The part of a surface that a face is.
#[derive(Clone, Debug)]
pub struct Trim {
    /// The surface with its periods and poles.
    pub chart: Chart,
    /// Whether the outward normal is opposite to `∂u × ∂v`.
    pub reversed: bool,
    /// Whether the loops bound nothing as the file has them, and all or some were gone along the other way: the side of the normal is then in
    /// doubt.
    pub turned: bool,
    /// Closed lines around the face, with the face on their left; all within `window`.
    pub rings: Vec<Ring>,
    /// First and last `u` and `v` of the rings.
    pub window: [[f64; 2]; 2],
    /// Where a parameter that repeats was cut: the window is within one period from there.
    pub cuts: [Option<f64>; 2],
    /// Greatest distance of the edges from the surface and from each other where they meet, millimeters.
    pub gap: f64,
    /// Edges of the border, ascending, and their curves.
    pub edges: Vec<u32>,
    /// The curves of `edges`.
    pub spans: Vec<Span>,
    outline: Outline,
}

/// Edges farther from their surface than this share of the face are taken for a mistake, unless the file says that it is that uncertain.
const MOST_GAP_SHARE: f64 = 1e-2;
/// A gap of so many times the file's uncertainty may still be meant: its edges may be off on both sides, and corners of three.
const MOST_UNCERTAINTIES: f64 = 10.0;
/// Share of the face within which places are one: files have about ten digits.
const REACH_SHARE: f64 = 1e-7;
/// Places of an edge by which the size of a face is judged.
const PLACES_OF_EDGE: usize = 8;

impl Trim {
    /// The part of its surface that a face of a part is; `uncertainty` is what the file says of its lengths, millimeters, 0 if nothing.
    ///
    /// # Errors
    /// [`TrimError`]: what in its border contradicts itself.
    pub fn new(brep: &Brep, face: &Face, uncertainty: f64) -> Result<Trim, TrimError> {
        match &face.bounds {
            Bounds::Rectangle(sides) => Trim::rectangle(face, sides),
            Bounds::Loops(loops) => {
                let uses = chain::bounding_uses(loops, face.reversed)?;
                let border = Border::new(brep, face, &uses, uncertainty)?;
                match border.trim(&uses, false) {
                    Err(TrimError::Contradiction) => {
                        let turned = chain::bounding_uses(loops, !face.reversed)?;
                        border.trim(&turned, true).or_else(|_| border.few_turned(loops))
                    }
                    other => other,
                }
            }
        }
    }

    /// All between first and last values of the parameters.
    fn rectangle(face: &Face, sides: &[[f64; 2]; 2]) -> Result<Trim, TrimError> {
        let own = face.surface.domain();
        let sides: [[f64; 2]; 2] = std::array::from_fn(|k| {
            [0, 1].map(|end| if sides[k][end].is_finite() { sides[k][end] } else { own[k][end] })
        });
        if sides.iter().flatten().any(|x| !x.is_finite()) {
            return Err(TrimError::NoBorder);
        }
        let middle = sides.map(|[a, b]| 0.5 * (a + b));
        let chart = Chart::new(&face.surface, &[face.surface.at(middle[0], middle[1])]);
        let kind = |k: usize, end: usize| {
            let width = sides[k][1] - sides[k][0];
            let is_near = |a: f64, b: f64| (a - b).abs() <= SAME_PARAMETER * width;
            match chart.periods[k] {
                Some(period) if is_near(width, period) => Straight::Cut(k),
                None if chart.poles[k][end].is_some() && is_near(sides[k][end], chart.domain[k][end]) => {
                    Straight::Pole((k, end))
                }
                _ => Straight::Side,
            }
        };
        let [[u0, u1], [v0, v1]] = sides;
        let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]];
        let kinds = [kind(1, 0), kind(0, 1), kind(1, 1), kind(0, 0)];
        let piece = |i: usize| Piece::Straight { ends: [corners[i], corners[(i + 1) % 4]], kind: kinds[i] };
        let rings = vec![Ring { pieces: (0..4).map(piece).collect(), winding: [0; 2] }];
        let cuts = [0, 1].map(|k| chart.periods[k].map(|_| sides[k][0]));
        let parts = Parts {
            chart,
            reversed: face.reversed,
            turned: false,
            rings,
            cuts,
            gap: 0.0,
            edges: vec![],
            spans: vec![],
        };
        Trim::of_rings(parts, 0.0)
    }

    fn of_rings(parts: Parts, reach: f64) -> Result<Trim, TrimError> {
        let Parts { chart, reversed, turned, rings, cuts, gap, edges, spans } = parts;
        let outline = Outline::new(&rings, |piece, share| parameters(&rings, &chart, &spans, piece, share));
        if outline.area().is_nan() || outline.area() <= 0.0 || !outline.nests() {
            return Err(TrimError::Contradiction);
        }
        if let Some([a, b]) = outline.crossing(&rings, &chart, 4.0 * gap + reach) {
            return Err(TrimError::Crossing(a, b));
        }
        let window = outline.window();
        Ok(Trim { chart, reversed, turned, rings, window, cuts, gap, edges, spans, outline })
    }

    /// Whether the face has the place with these parameters, whatever number of periods they are away. Places on the border, up to rounding,
    /// belong to it.
    ///
    /// Decided by a polygon, and next to it by the edge itself. Cost: some dozen comparisons, and close to an edge some dozen projections.
    pub fn contains(&self, at: [f64; 2]) -> bool {
        let at = self.chart.between_poles(at);
        let home: [f64; 2] = std::array::from_fn(|k| match (self.chart.periods[k], self.cuts[k]) {
            (Some(period), Some(cut)) => at[k] - period * ((at[k] - cut) / period).floor(),
            _ => at[k],
        });
        let at = |piece, share| parameters(&self.rings, &self.chart, &self.spans, piece, share);
        self.outline.contains(home, at)
    }
}

/// The parameters of a piece at a share of its edge.
fn parameters(rings: &[Ring], chart: &Chart, spans: &[Span], (ring, piece): PieceId, share: f64) -> [f64; 2] {
    match &rings[ring].pieces[piece] {
        Piece::Edge(strand) => strand.at(chart, &spans[strand.slot], share),
        Piece::Straight { ends: [from, _], .. } => *from,
    }
}

/// What the rings of a face are made with.
struct Border<'a> {
    face: &'a Face,
    chart: Chart,
    edges: Vec<u32>,
    spans: Vec<Span>,
    /// Places nearer than that are one.
    reach: f64,
    /// Edges farther than that from each other or from the surface are a mistake.
    most_open: f64,
}

impl<'a> Border<'a> {
    fn new(
        brep: &Brep,
        face: &'a Face,
        uses: &[Vec<EdgeUse>],
        uncertainty: f64,
    ) -> Result<Border<'a>, TrimError> {
        let mut edges: Vec<u32> = uses.iter().flatten().map(|u| u.edge).collect();
        edges.sort_unstable();
        edges.dedup();
        let span = |e: &u32| brep.edges.get(*e as usize).map(|e| e.span.clone()).ok_or(TrimError::NoEdge(*e));
        let spans: Vec<Span> = edges.iter().map(span).collect::<Result<_, _>>()?;
        let places: Vec<Point> = spans.iter().flat_map(places_of).collect();
        if let Some(i) = places.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            return Err(TrimError::NotFinite(edges[i / (PLACES_OF_EDGE + 1)]));
        }
        let size = if places.is_empty() { 0.0 } else { Aabb::of(&places).diagonal() };
        let chart = Chart::new(&face.surface, &places);
        let most_open = (MOST_UNCERTAINTIES * uncertainty).max(MOST_GAP_SHARE * size);
        let reach = uncertainty.max(REACH_SHARE * size);
        Ok(Border { face, chart, edges, spans, reach, most_open })
    }

    /// The only trim with as few turned loops as can be.
    fn few_turned(&self, loops: &[Loop]) -> Result<Trim, TrimError> {
        for choices in senses::choices(loops) {
            let mut found = choices.iter().filter_map(|loops| {
                let uses = chain::bounding_uses(loops, self.face.reversed).ok()?;
                self.trim(&uses, true).ok()
            });
            match (found.next(), found.next()) {
                (Some(only), None) => return Ok(only),
                (Some(_), Some(_)) => break,
                (None, _) => {}
            }
        }
        Err(TrimError::Contradiction)
    }

    fn trim(&self, uses: &[Vec<EdgeUse>], turned: bool) -> Result<Trim, TrimError> {
        let Border { face, chart, edges, spans, reach, most_open } = self;
        let chainer = chain::Chainer { chart, edges, spans, reach: *reach, most_open: *most_open };
        let mut rings = vec![];
        for chain in uses {
            rings.extend(chainer.ring(chain)?);
        }
        let gap = gap_of(chart, spans, &rings, *most_open)?;
        let (cuts, rings) = opened(chart, spans, rings)?;
        let parts = Parts {
            chart: chart.clone(),
            reversed: face.reversed,
            turned,
            rings,
            cuts,
            gap,
            edges: edges.clone(),
            spans: spans.clone(),
        };
        Trim::of_rings(parts, *reach)
    }
}

/// What a trim is made of.
struct Parts {
    chart: Chart,
    reversed: bool,
    turned: bool,
    rings: Vec<Ring>,
    cuts: [Option<f64>; 2],
    gap: f64,
    edges: Vec<u32>,
    spans: Vec<Span>,
}

/// Rings cut open along all parameters that repeat, and where.
fn opened(
    chart: &Chart,
    spans: &[Span],
    mut rings: Vec<Ring>,
) -> Result<([Option<f64>; 2], Vec<Ring>), TrimError> {
    let mut cuts = [None; 2];
    for (k, own) in cuts.iter_mut().enumerate() {
        if let Some(period) = chart.periods[k] {
            let other = if k == 0 { chart.periods[1] } else { None };
            let (cut, open) = open::Opener { chart, spans, k, period, other }.open(rings)?;
            (*own, rings) = (Some(cut), open);
        }
    }
    if rings.is_empty() {
        return Err(TrimError::NoBorder);
    }
    match rings.iter().all(|r| r.winding == [0, 0]) {
        true => Ok((cuts, rings)),
        false => Err(TrimError::Contradiction),
    }
}

/// Greatest distance of edges from the surface, and of the ends of edges that meet.
fn gap_of(chart: &Chart, spans: &[Span], rings: &[Ring], most: f64) -> Result<f64, TrimError> {
    let mut gap = 0.0f64;
    for ring in rings {
        let mut before: Option<Point> = None;
        let strands = ring.pieces.iter().filter_map(|p| if let Piece::Edge(s) = p { Some(s) } else { None });
        for strand in strands {
            let span = &spans[strand.slot];
            let distance = strand::gap(strand, chart, span);
            if distance.is_nan() || distance > most {
                return Err(TrimError::Off { edge: strand.edge, distance });
            }
            let [start, end] = strand.shares().map(|s| span.derivatives(s)[0]);
            let open =
                before.map_or(0.0, |b| trueness_geom::space::norm(trueness_geom::space::minus(b, start)));
            gap = gap.max(distance).max(open);
            before = Some(end);
        }
    }
    Ok(gap)
}

/// Places along an edge.
fn places_of(span: &Span) -> Vec<Point> {
    (0..=PLACES_OF_EDGE).map(|i| span.derivatives(i as f64 / PLACES_OF_EDGE as f64)[0]).collect()
}
