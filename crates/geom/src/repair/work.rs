//! The mesh under repair, and what is known about it.
//!
//! Places are never written: vertices are only added behind the others, and facets only name other vertices. So no
//! vertex can move, whatever a step does.

use super::change::Change;
use super::error::RepairError;
use super::options::Options;
use super::pairs::Pairs;
use crate::arrange::ArrangeError;
use crate::check::around::Around;
use crate::check::intersect::{self, Crossings};
use crate::check::{self, Finding, Kind, Known, Report};
use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, plus, times};
use crate::topology::Topology;
use std::collections::BTreeSet;
use std::sync::Arc;

/// What a step works on.
pub(super) struct Work<'a> {
    /// Copied only when it changes while an earlier state still holds it.
    mesh: Arc<Mesh>,
    pub options: &'a Options,
    pub progress: &'a dyn Progress,
    /// Distance, mm, up to which two places may have been meant as one.
    pub gap: f64,
    /// All coordinates have single precision: new ones shall have too.
    single: bool,
    pub changes: Vec<Change>,
    /// Vertices at the rims of holes that a step has torn: those holes must be filled whatever their size.
    torn: BTreeSet<u32>,
    /// Vertices that were parted from others on purpose and must not be joined again.
    pub parted: BTreeSet<u32>,
    /// Torn holes have been widened.
    pub widened: bool,
    /// Area, mm², by which they may still be.
    pub may_widen: f64,
    /// The most facets that cutting may come to. A facet has three edges, and a vertex lies on one as a rule; but where
    /// sheets lie closer together than the gap, each lies on very many, and cutting makes ever more of both.
    most_facets: usize,
    /// Nothing else has helped: crossing facets may be torn out.
    pub may_tear: bool,
    /// Why shells that meet were not united.
    pub not_united: Option<ArrangeError>,
    /// Corners of the facets that were removed so that the rest can be closed.
    pub lost: Vec<[Point; 3]>,
    known: Option<Arc<Known>>,
    /// Pairs of its facets that meet where they should not, as far as they are known.
    pairs: Pairs,
}

impl<'a> Work<'a> {
    /// Of a welded mesh.
    pub(super) fn new(
        mesh: Mesh,
        options: &'a Options,
        progress: &'a dyn Progress,
    ) -> Result<Work<'a>, RepairError> {
        let single = mesh.is_single();
        let mut work = Work {
            most_facets: 100 + 4 * mesh.faces.len(),
            mesh: Arc::new(mesh),
            options,
            progress,
            gap: 0.0,
            single,
            changes: vec![],
            torn: BTreeSet::new(),
            parted: BTreeSet::new(),
            widened: false,
            may_widen: 0.0,
            may_tear: false,
            not_united: None,
            lost: vec![],
            known: None,
            pairs: Pairs::Unknown,
        };
        let spacing = check::spacing(&work.known()?.properties.bounds);
        work.gap = options.gap.unwrap_or(8.0 * spacing);
        Ok(work)
    }

    /// The same mesh under other options, nothing done yet. What is known about it is kept.
    pub(super) fn again<'b>(&self, options: &'b Options) -> Work<'b>
    where
        'a: 'b,
    {
        Work {
            mesh: self.mesh.clone(),
            options,
            changes: vec![],
            torn: BTreeSet::new(),
            parted: BTreeSet::new(),
            lost: vec![],
            known: self.known.clone(),
            pairs: self.pairs.clone(),
            ..*self
        }
    }

    /// The same state under other options.
    pub(super) fn copy<'b>(&self, options: &'b Options, progress: &'b dyn Progress) -> Work<'b> {
        Work {
            mesh: self.mesh.clone(),
            options,
            progress,
            changes: self.changes.clone(),
            torn: self.torn.clone(),
            parted: self.parted.clone(),
            lost: self.lost.clone(),
            known: self.known.clone(),
            pairs: self.pairs.clone(),
            ..*self
        }
    }

    /// Whether anything has changed since that state.
    pub(super) fn is_beyond(&self, earlier: &Work) -> bool {
        let is_same = Arc::ptr_eq(&self.mesh, &earlier.mesh) || self.mesh == earlier.mesh;
        self.changes.len() != earlier.changes.len() || !is_same
    }

    pub(super) fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The mesh as it is, to compare with it or to go back to it.
    pub(super) fn shared(&self) -> Arc<Mesh> {
        self.mesh.clone()
    }

    pub(super) fn into_mesh(self) -> Mesh {
        Arc::unwrap_or_clone(self.mesh)
    }

    fn mesh_mut(&mut self) -> &mut Mesh {
        Arc::make_mut(&mut self.mesh)
    }

    /// Goes on with `mesh`: the same facets at the same places, without the vertices that no facet uses. `same`: apart from that,
    /// facets name the same corners.
    pub(super) fn compacted(&mut self, mesh: Mesh, same: bool) {
        let known = self.known.take().filter(|_| same);
        self.known = known.and_then(|known| known.compacted(&mesh)).map(Arc::new);
        self.mesh = Arc::new(mesh);
        if !same {
            self.pairs = Pairs::Unknown;
        }
    }

    pub(super) fn at(&self, vertex: u32) -> Point {
        self.mesh.positions[vertex as usize]
    }

    pub(super) fn corners(&self, facet: u32) -> [Point; 3] {
        self.mesh.corners(facet)
    }

    /// How many facets cutting may still add.
    pub(super) fn room(&self) -> usize {
        self.most_facets.saturating_sub(self.mesh.faces.len())
    }

    /// The middle of a facet.
    pub(super) fn middle(&self, facet: u32) -> Point {
        let [a, b, c] = self.corners(facet);
        times(1.0 / 3.0, plus(a, plus(b, c)))
    }

    /// An error where the repair shall stop: asked in loops that may last.
    pub(super) fn go_on(&self) -> Result<(), Cancelled> {
        if self.progress.cancelled() { Err(Cancelled) } else { Ok(()) }
    }

    /// What follows from the mesh as it is; computed again after a change only.
    pub(super) fn known(&mut self) -> Result<Arc<Known>, RepairError> {
        self.go_on()?;
        if let Some(known) = &self.known {
            return Ok(known.clone());
        }
        let known = Arc::new(check::known(&self.mesh, self.progress)?);
        self.known = Some(known.clone());
        Ok(known)
    }

    /// What the check says of the mesh as it is.
    pub(super) fn report(&mut self, options: &check::Options) -> Result<Report, RepairError> {
        let known = self.known()?;
        let all = self.all_crossings()?.and_then(|pairs| Crossings::of_all(pairs, options.limit));
        let crossings = match all {
            Some(crossings) => crossings,
            None => intersect::first_self_intersections(
                &self.mesh,
                &known.topology,
                options.limit,
                self.progress,
            )?,
        };
        let gap = options.gap.unwrap_or(8.0 * check::spacing(&known.properties.bounds));
        let inspected = known.inspected(&self.mesh, Some(&crossings), (options, gap), self.progress);
        Ok(check::report(&inspected)?)
    }

    /// Pairs of facets that meet where they should not, at least one of them chosen (by number and corners): of facets that
    /// change, all others stay as they are. `None` for a tangle, where pairs outnumber facets many times.
    pub(super) fn crossings(
        &mut self,
        chosen: impl Fn(u32, &[u32; 3]) -> bool,
    ) -> Result<Option<Vec<[u32; 2]>>, RepairError> {
        let some: Vec<bool> = (0..).zip(&self.mesh.faces).map(|(f, face)| chosen(f, face)).collect();
        if !some.contains(&true) {
            return Ok(Some(vec![]));
        }
        if matches!(self.pairs, Pairs::Unknown)
            && let Some(around) = Around::new(&self.mesh, &some)
        {
            let topology = Topology::watched(&around.mesh, self.progress)?;
            return self.crossings_around(&around, &topology);
        }
        if let Some(all) = self.all_crossings()? {
            let asked = |pair: &&[u32; 2]| pair.iter().any(|f| some[*f as usize]);
            return Ok(Some(all.iter().filter(asked).copied().collect()));
        }
        if !some.contains(&false) { Ok(None) } else { self.search(&some) }
    }

    /// All pairs of facets that meet where they should not; `None` for a tangle. Only what has changed since they were known is
    /// looked at.
    pub(super) fn all_crossings(&mut self) -> Result<Option<&[[u32; 2]]>, RepairError> {
        let facets = self.mesh.faces.len();
        let mut pairs = std::mem::take(&mut self.pairs);
        if let Some(new) = pairs.new_facets(facets) {
            let some: Vec<bool> = (0..facets).map(|f| new.contains(&f)).collect();
            let found = match Around::new(&self.mesh, &some) {
                Some(around) => {
                    let topology = Topology::watched(&around.mesh, self.progress)?;
                    self.crossings_around(&around, &topology)?
                }
                None => self.search(&some)?,
            };
            pairs.take_in(found, facets);
        }
        self.pairs = pairs;
        let most = self.most_crossings();
        Ok(self.pairs.all().filter(|all| all.len() <= most))
    }

    /// Why nothing comes of it: most edges have one facet only, and facets cross without number. No step makes a surface of that. A
    /// small one is gone through all the same, for what lies beside it.
    pub(super) fn soup(&mut self) -> Result<Option<ArrangeError>, RepairError> {
        /// With so many free edges the steps take about a second.
        const SMALL: usize = 5_000;
        let topology = &self.known()?.topology;
        let free = topology.boundary_edges.len();
        let is_loose = free > topology.counting_facets.max(SMALL);
        let is_soup = is_loose && self.all_crossings()?.is_none();
        Ok(is_soup.then(|| ArrangeError::Tangle { most: self.most_crossings() }))
    }

    /// As [`Work::crossings`], of facets with a flag each, in the whole mesh.
    fn search(&mut self, some: &[bool]) -> Result<Option<Vec<[u32; 2]>>, RepairError> {
        let (known, most) = (self.known()?, self.most_crossings());
        Ok(intersect::few_self_intersections(&self.mesh, &known.topology, some, most, self.progress)?)
    }

    /// As [`Work::crossings`], of facets whose surroundings and their topology are at hand.
    pub(super) fn crossings_around(
        &self,
        around: &Around,
        topology: &Topology,
    ) -> Result<Option<Vec<[u32; 2]>>, RepairError> {
        let (most, Around { mesh, numbers, asked }) = (self.most_crossings(), around);
        let found = intersect::few_self_intersections(mesh, topology, asked, most, self.progress)?;
        let whole =
            |pairs: Vec<[u32; 2]>| pairs.into_iter().map(|p| p.map(|f| numbers[f as usize])).collect();
        Ok(found.map(whole))
    }

    /// Pairs beyond which the mesh is a tangle.
    fn most_crossings(&self) -> usize {
        const FEW: usize = 10_000;
        FEW + 8 * self.mesh.faces.len()
    }

    /// All that the check finds of a kind which needs no crossings.
    pub(super) fn find(&mut self, kind: &Kind) -> Result<Vec<Finding>, RepairError> {
        let known = self.known()?;
        let default = check::Options::default();
        let island_share = self.options.islands.unwrap_or(default.island_share);
        let options = check::Options { limit: usize::MAX, island_share, ..default };
        let inspected = known.inspected(&self.mesh, None, (&options, self.gap), self.progress);
        let found = (kind.find)(&inspected).map_or(vec![], |found| found.items);
        self.go_on()?;
        Ok(found)
    }

    /// Removes facets (numbers in any order, repeated or not) and adds others behind the rest.
    pub(super) fn replace(&mut self, removed: &[u32], added: &[[u32; 3]]) {
        if !removed.is_empty() {
            let mut keep = vec![true; self.mesh.faces.len()];
            removed.iter().for_each(|&f| keep[f as usize] = false);
            self.pairs.keep(&keep);
            let mut keep = keep.into_iter();
            self.mesh_mut().faces.retain(|_| keep.next().unwrap_or(true));
        }
        if !added.is_empty() {
            self.mesh_mut().faces.extend_from_slice(added);
        }
        self.known = None;
    }

    /// Turns facets over.
    pub(super) fn turn(&mut self, facets: impl IntoIterator<Item = u32>) {
        let mesh = self.mesh_mut();
        facets.into_iter().for_each(|f| mesh.faces[f as usize].swap(1, 2));
        self.known = None;
        self.pairs = Pairs::Unknown;
    }

    /// Lets every corner `v` name `other(facet, v)` instead.
    pub(super) fn rename(&mut self, other: impl Fn(u32, u32) -> u32) {
        for (f, face) in (0..).zip(&mut self.mesh_mut().faces) {
            *face = face.map(|v| other(f, v));
        }
        self.known = None;
        self.pairs = Pairs::Unknown;
    }

    /// A new vertex at `place`, rounded to single precision where all others are.
    pub(super) fn add(&mut self, place: Point) -> u32 {
        let place = self.rounded(place);
        self.mesh_mut().positions.push(place);
        self.known = None;
        self.mesh.positions.len() as u32 - 1
    }

    /// New vertices, as they are.
    pub(super) fn append(&mut self, places: &[Point]) {
        self.mesh_mut().positions.extend_from_slice(places);
        self.known = None;
    }

    /// `place` in the precision of the mesh.
    pub(super) fn rounded(&self, place: Point) -> Point {
        // Adding zero makes −0 the 0 that a weld would make of it.
        place.map(|x| if self.single { f64::from(x as f32) + 0.0 } else { x + 0.0 })
    }

    /// Forgets facets and vertices that were added behind these and turned out not to be wanted.
    pub(super) fn truncate(&mut self, facets: u32, vertices: usize) {
        let keep: Vec<bool> = (0..self.mesh.faces.len()).map(|f| f < facets as usize).collect();
        self.pairs.keep(&keep);
        let mesh = self.mesh_mut();
        mesh.faces.truncate(facets as usize);
        mesh.positions.truncate(vertices);
        self.known = None;
    }

    /// Removes facets and remembers that the hole is ours.
    pub(super) fn tear(&mut self, removed: &[u32]) {
        let faces = &self.mesh.faces;
        self.torn.extend(removed.iter().flat_map(|f| faces[*f as usize]));
        self.lose(removed);
    }

    /// Removes facets and remembers where they were.
    pub(super) fn lose(&mut self, removed: &[u32]) {
        self.lost.extend(removed.iter().map(|f| self.mesh.corners(*f)));
        self.replace(removed, &[]);
    }

    /// Goes back to an earlier state; its vertices must be the first of those now.
    pub(super) fn restore(&mut self, earlier: Arc<Mesh>) {
        self.mesh = earlier;
        self.known = None;
        self.pairs = Pairs::Unknown;
    }

    /// Whether the ring is the rim of a hole that a step has torn.
    pub(super) fn is_torn(&self, ring: &[u32]) -> bool {
        ring.iter().all(|v| self.torn.contains(v))
    }

    /// Whether a hole that a step has torn is still open.
    pub(super) fn has_torn_hole(&mut self) -> Result<bool, RepairError> {
        Ok(self.known()?.free_edges.rings.iter().any(|ring| self.is_torn(ring)))
    }

    pub(super) fn log(
        &mut self,
        step: &'static str,
        what: &'static str,
        position: Point,
        facets: usize,
        size: f64,
    ) {
        self.changes.push(Change { step, what, position, facets, size });
    }
}
