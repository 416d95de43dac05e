//! Neighboring regions that are one face: pieces of one element that form error or a scratch kept apart.

use super::grow::{Context, MAX_FITTED_POINTS};
use super::pieces::NO_PIECE;
use super::probe::Probe;
use super::region::GrownRegion;
use crate::fit::improved;
use crate::shape::Shape;
use crate::space::Point;

/// Root mean square about one element over that about two, from which on they are two. Equal regions whose elements are off by
/// one standard deviation of the points have 1.12.
const TWO_ELEMENTS_RATIO: f64 = 1.25;

/// Joins regions that one element explains as well as two. Labels of regions that are gone are replaced; the regions
/// themselves stay in place, without pieces.
pub(super) fn merge(context: &Context, regions: &mut [GrownRegion], labels: &mut [u32]) {
    // Each pass may bring new neighbors together.
    while let Some((kept, gone, shape, rms)) = next(context, regions, labels) {
        let pieces = std::mem::take(&mut regions[gone].pieces);
        pieces.iter().for_each(|&p| labels[p as usize] = kept as u32);
        let weight = std::mem::take(&mut regions[gone].weight);
        let whole = &mut regions[kept];
        whole.pieces.extend(pieces);
        whole.weight += weight;
        (whole.shape, whole.rms) = (shape, rms);
    }
}

/// The first pair of neighbors that are one, the heavier one first, and their element.
fn next(context: &Context, regions: &[GrownRegion], labels: &[u32]) -> Option<(usize, usize, Shape, f64)> {
    neighbors(context, labels).into_iter().find_map(|[a, b]| {
        let (a, b) = (a as usize, b as usize);
        let (large, small) = if regions[b].weight > regions[a].weight { (b, a) } else { (a, b) };
        let joint = joint(context, &regions[large], &regions[small])?;
        Some((large, small, joint.0, joint.1))
    })
}

/// The element of both, where it explains them as well as their own do.
fn joint(context: &Context, large: &GrownRegion, small: &GrownRegion) -> Option<(Shape, f64)> {
    let surface = context.surface;
    let places = |region: &GrownRegion| -> Vec<Point> {
        let mut places = surface.sampled_places(&region.pieces, MAX_FITTED_POINTS);
        places.retain(|&p| region.shape.distance(p).abs() <= context.band.distance);
        places
    };
    let (one, other) = (places(large), places(small));
    let both: Vec<Point> = one.iter().chain(&other).copied().collect();
    let (shape, _) = improved(&both, &large.shape)?;
    let square =
        |points: &[Point], shape: &Shape| points.iter().map(|&p| shape.distance(p).powi(2)).sum::<f64>();
    let apart = square(&one, &large.shape) + square(&other, &small.shape);
    let together = square(&one, &shape) + square(&other, &shape);
    let count = both.len() as f64;
    let floor = (context.noise * context.noise).max(1e-30);
    // The small one counts by itself too: among many points of the large one it would not show.
    let alone = square(&other, &shape) / other.len() as f64;
    let own = square(&other, &small.shape) / other.len() as f64;
    let element = Probe::new(&shape);
    let belong = small.pieces.iter().filter(|&&p| turned(context, p, &element)).count();
    let fits = together / count <= TWO_ELEMENTS_RATIO * TWO_ELEMENTS_RATIO * (apart / count).max(floor)
        && alone <= 4.0 * own.max(floor)
        && 10 * belong >= 9 * small.pieces.len();
    fits.then(|| (shape, (together / count).sqrt()))
}

/// Whether the piece looks the way the element does.
fn turned(context: &Context, piece: u32, element: &Probe) -> bool {
    let i = piece as usize;
    element.cosine(context.surface.places[i], context.surface.normals[i]) >= context.band.cosine
}

/// Pairs of regions that touch, or that one piece of no region lies between.
fn neighbors(context: &Context, labels: &[u32]) -> Vec<[u32; 2]> {
    let surface = context.surface;
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let mut around: Vec<u32> = Vec::new();
    for piece in 0..surface.len() as u32 {
        around.clear();
        around
            .extend(surface.neighbors(piece).iter().map(|&n| labels[n as usize]).filter(|&l| l != NO_PIECE));
        let own = labels[piece as usize];
        if own != NO_PIECE {
            around.retain(|&l| l != own);
            around.insert(0, own);
        }
        around.sort_unstable();
        around.dedup();
        for (i, &a) in around.iter().enumerate() {
            pairs.extend(around[i + 1..].iter().map(|&b| [a, b]));
        }
        if pairs.len() > 1 << 16 {
            pairs.sort_unstable();
            pairs.dedup();
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

#[cfg(test)]
mod tests {
    use super::super::pieces::Band;
    use super::super::tests::{context, parts::bored};
    use super::*;
    use crate::mesh::Mesh;
    use crate::shape::Kind;

    /// A region of these pieces.
    fn region(context: &Context, start: Shape, pieces: Vec<u32>) -> GrownRegion {
        let (shape, rms) =
            improved(&context.surface.sampled_places(&pieces, MAX_FITTED_POINTS), &start).unwrap();
        GrownRegion { shape, weight: context.surface.weight(&pieces), pieces, rms, middles: rms }
    }

    fn labels(regions: &[GrownRegion], count: usize) -> Vec<u32> {
        let mut labels = vec![NO_PIECE; count];
        for (label, region) in regions.iter().enumerate() {
            region.pieces.iter().for_each(|&p| labels[p as usize] = label as u32);
        }
        labels
    }

    /// Small and large: a bore of 0.24 mm as one of 240 mm.
    #[test]
    fn halves_of_a_face_become_one_and_two_faces_stay_two() {
        for scale in [0.03, 1.0, 30.0] {
            let mut part = bored(64).noisy(0.01, 6);
            part.mesh.positions.iter_mut().flatten().for_each(|x| *x *= scale);
            let [point, top, direction] = [[0.0; 3], [0.0, 0.0, 12.0 * scale], [0.0, 0.0, 1.0]];
            let faces = [
                Shape::Cylinder { point, direction, radius: 8.0 * scale },
                Shape::Plane { point: top, normal: direction },
            ];
            context(&part.mesh, |context| {
                let Band { distance, cosine } = context.band;
                let band = Band { distance: scale * distance, cosine };
                let context = Context { band, noise: scale * context.noise, ..*context };
                check_halves(&part.labels, &faces, &context);
            });
        }
    }

    fn check_halves(faces_of: &[usize], faces: &[Shape; 2], context: &Context) {
        let of = |face: usize, right: bool| -> Vec<u32> {
            let all = 0..faces_of.len();
            let here = |&p: &usize| faces_of[p] == face && (context.surface.places[p][0] > 0.0) == right;
            all.filter(here).map(|p| p as u32).collect()
        };
        let halves = [(0, true), (0, false), (1, true), (1, false)];
        let mut regions: Vec<GrownRegion> =
            halves.iter().map(|&(face, right)| region(context, faces[face], of(face, right))).collect();
        let mut labels = labels(&regions, faces_of.len());
        merge(context, &mut regions, &mut labels);
        let left: Vec<&GrownRegion> = regions.iter().filter(|r| !r.pieces.is_empty()).collect();
        assert_eq!(left.len(), 2, "{left:?}");
        for face in [0, 1] {
            let mut expected = of(face, true);
            expected.extend(of(face, false));
            let label = labels[expected[0] as usize];
            assert!(expected.iter().all(|&p| labels[p as usize] == label));
            let whole = &regions[label as usize];
            assert_eq!((whole.pieces.len(), whole.shape.kind()), (expected.len(), faces[face].kind()));
            assert!((whole.weight - context.surface.weight(&expected)).abs() < 1e-9 * whole.weight);
        }
    }

    /// A step of three standard deviations: its wall lies near enough to the plane, but does not look its way.
    #[test]
    fn a_low_wall_is_no_part_of_the_plane_below() {
        const LONG: u32 = 30;
        let mut mesh = Mesh::default();
        for [x, z] in [[-3.0, 0.0], [-2.0, 0.0], [-1.0, 0.0], [0.0, 0.0], [0.0, 0.03]] {
            mesh.positions.extend((0..=LONG).map(|k| [x, f64::from(k), z]));
        }
        for row in 0..4 {
            for k in 0..LONG {
                let [a, b] = [row * (LONG + 1) + k, (row + 1) * (LONG + 1) + k];
                mesh.faces.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
            }
        }
        context(&mesh, |context| {
            let count = mesh.faces.len() as u32;
            let plane = |normal| Shape::Plane { point: [0.0; 3], normal };
            let wall = 2 * 3 * LONG;
            let floor = region(context, plane([0.0, 0.0, 1.0]), (0..wall).collect());
            let wall = region(context, plane([1.0, 0.0, 0.0]), (wall..count).collect());
            let mut regions = [floor, wall];
            let mut labels = labels(&regions, count as usize);
            merge(context, &mut regions, &mut labels);
            assert!(regions.iter().all(|r| !r.pieces.is_empty() && r.shape.kind() == Kind::Plane));
        });
    }
}
