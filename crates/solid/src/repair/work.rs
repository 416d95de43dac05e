//! The mesh under repair: the questions of the steps, and their changes.
//!
//! Places are never written: vertices are only added behind the others, and facets only name other vertices. So no
//! vertex can move, whatever a step does.

use super::change::Change;
use super::error::RepairError;
use super::options::Options;
use super::pairs::Pairs;
use super::state::State;
use super::step::Step;
use crate::arrange::ArrangeError;
use crate::neighborhood::Neighborhood;
use std::sync::Arc;
use trueness_geom::check::intersect::{self, Crossings};
use trueness_geom::check::{self, DefectKind, Finding, Known, Report};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, plus, times};
use trueness_geom::topology::Topology;

/// Material of a step: a state, and the options of the repair.
pub(super) struct Work<'a> {
    pub state: State,
    pub options: &'a Options,
    pub progress: &'a dyn Progress,
    /// Distance, mm, up to which two places may have been meant as one.
    pub gap: f64,
    /// All coordinates have single precision: new ones shall have too.
    single: bool,
    /// The most facets that cutting may come to. A facet has three edges, and a vertex lies on one as a rule. But where
    /// sheets lie closer together than the gap, each lies on very many, and cutting makes ever more of both.
    most_facets: usize,
}

impl<'a> Work<'a> {
    /// Work on a welded mesh.
    pub(super) fn new(
        mesh: Mesh,
        options: &'a Options,
        progress: &'a dyn Progress,
    ) -> Result<Work<'a>, RepairError> {
        let (single, most_facets) = (mesh.is_single(), 100 + 4 * mesh.faces.len());
        let mut work = Work { state: State::of(mesh), options, progress, gap: 0.0, single, most_facets };
        let spacing = check::spacing(&work.known()?.properties.bounds);
        work.gap = options.gap.unwrap_or(8.0 * spacing);
        Ok(work)
    }

    /// The same mesh under other options, nothing done yet. Known facts about it are kept.
    pub(super) fn again<'b>(&self, options: &'b Options) -> Work<'b>
    where
        'a: 'b,
    {
        Work { state: self.state.untouched(), options, ..*self }
    }

    /// That state under other options.
    pub(super) fn resumed<'b>(&self, state: &State, options: &'b Options) -> Work<'b>
    where
        'a: 'b,
    {
        Work { state: state.clone(), options, ..*self }
    }

    pub(super) fn mesh(&self) -> &Mesh {
        &self.state.mesh
    }

    /// The mesh as it is, to compare with it or to go back to it.
    pub(super) fn shared(&self) -> Arc<Mesh> {
        self.state.mesh.clone()
    }

    pub(super) fn into_mesh(self) -> Mesh {
        Arc::unwrap_or_clone(self.state.mesh)
    }

    fn mesh_mut(&mut self) -> &mut Mesh {
        Arc::make_mut(&mut self.state.mesh)
    }

    /// Goes on with `mesh`: the same facets at the same places, without the vertices that no facet uses. `same`: apart from that,
    /// facets name the same corners.
    pub(super) fn compacted(&mut self, mesh: Mesh, same: bool) {
        let known = self.state.known.take().filter(|_| same);
        self.state.known = known.and_then(|known| known.compacted(&mesh)).map(Arc::new);
        self.state.mesh = Arc::new(mesh);
        if !same {
            self.state.pairs = Pairs::Unknown;
        }
    }

    pub(super) fn at(&self, vertex: u32) -> Point {
        self.state.mesh.positions[vertex as usize]
    }

    pub(super) fn corners(&self, facet: u32) -> [Point; 3] {
        self.state.mesh.corners(facet)
    }

    /// How many facets cutting may still add.
    pub(super) fn room(&self) -> usize {
        self.most_facets.saturating_sub(self.state.mesh.faces.len())
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

    /// Facts that follow from the mesh as it is; computed again after a change only.
    pub(super) fn known(&mut self) -> Result<Arc<Known>, RepairError> {
        self.go_on()?;
        if let Some(known) = &self.state.known {
            return Ok(known.clone());
        }
        let known = Arc::new(check::known(&self.state.mesh, self.progress)?);
        self.state.known = Some(known.clone());
        Ok(known)
    }

    /// Report of the check on the mesh as it is.
    pub(super) fn report(&mut self, options: &check::Options) -> Result<Report, RepairError> {
        let known = self.known()?;
        let all = self.all_crossings()?.and_then(|pairs| Crossings::of_all(pairs, options.limit));
        let crossings = match all {
            Some(crossings) => crossings,
            None => intersect::first_self_intersections(
                &self.state.mesh,
                &known.topology,
                options.limit,
                self.progress,
            )?,
        };
        let gap = options.gap.unwrap_or(8.0 * check::spacing(&known.properties.bounds));
        let inspected = known.inspected(&self.state.mesh, Some(&crossings), (options, gap), self.progress);
        Ok(check::report(&inspected)?)
    }

    /// Pairs of facets that meet where they should not, at least one of them chosen (by number and corners). Chosen
    /// facets change, and all others stay as they are. `None` for a tangle, where pairs outnumber facets many times.
    pub(super) fn crossings(
        &mut self,
        chosen: impl Fn(u32, &[u32; 3]) -> bool,
    ) -> Result<Option<Vec<[u32; 2]>>, RepairError> {
        let is_chosen: Vec<bool> =
            (0..).zip(&self.state.mesh.faces).map(|(f, face)| chosen(f, face)).collect();
        if !is_chosen.contains(&true) {
            return Ok(Some(vec![]));
        }
        if matches!(self.state.pairs, Pairs::Unknown)
            && let Some(around) = Neighborhood::new(&self.state.mesh, &is_chosen)
        {
            let topology = Topology::watched(&around.mesh, self.progress)?;
            return self.crossings_around(&around, &topology);
        }
        if let Some(all) = self.all_crossings()? {
            let is_chosen = |pair: &&[u32; 2]| pair.iter().any(|f| is_chosen[*f as usize]);
            return Ok(Some(all.iter().filter(is_chosen).copied().collect()));
        }
        if !is_chosen.contains(&false) { Ok(None) } else { self.search(&is_chosen) }
    }

    /// All pairs of facets that meet where they should not; `None` for a tangle. Only changes since they were known are
    /// looked at.
    pub(super) fn all_crossings(&mut self) -> Result<Option<&[[u32; 2]]>, RepairError> {
        let facets = self.state.mesh.faces.len();
        let mut pairs = std::mem::take(&mut self.state.pairs);
        if let Some(new) = pairs.new_facets(facets) {
            let is_chosen: Vec<bool> = (0..facets).map(|f| new.contains(&f)).collect();
            let found = match Neighborhood::new(&self.state.mesh, &is_chosen) {
                Some(around) => {
                    let topology = Topology::watched(&around.mesh, self.progress)?;
                    self.crossings_around(&around, &topology)?
                }
                None => self.search(&is_chosen)?,
            };
            pairs.take_in(found, facets);
        }
        self.state.pairs = pairs;
        let most = self.most_crossings();
        Ok(self.state.pairs.all().filter(|all| all.len() <= most))
    }

    /// An error for a soup of facets: most edges have one facet only, and too many pairs of facets cross to list them.
    /// No step makes a surface of that. A small soup is repaired all the same, for the sake of the surface beside it.
    pub(super) fn soup(&mut self) -> Result<Option<ArrangeError>, RepairError> {
        /// With so many boundary edges the steps take about a second.
        const MIN_LOOSE_EDGES: usize = 5_000;
        let topology = &self.known()?.topology;
        let free = topology.boundary_edges.len();
        let is_loose = free > topology.counting_facets.max(MIN_LOOSE_EDGES);
        let is_soup = is_loose && self.all_crossings()?.is_none();
        Ok(is_soup.then(|| ArrangeError::Tangle { most: self.most_crossings() }))
    }

    /// As [`Work::crossings`], of facets with a flag each, in the whole mesh.
    fn search(&mut self, is_chosen: &[bool]) -> Result<Option<Vec<[u32; 2]>>, RepairError> {
        let (known, most) = (self.known()?, self.most_crossings());
        Ok(intersect::selected_self_intersections(
            &self.state.mesh,
            &known.topology,
            is_chosen,
            most,
            self.progress,
        )?)
    }

    /// As [`Work::crossings`], of facets whose surroundings and their topology are at hand.
    pub(super) fn crossings_around(
        &self,
        around: &Neighborhood,
        topology: &Topology,
    ) -> Result<Option<Vec<[u32; 2]>>, RepairError> {
        let (most, Neighborhood { mesh, numbers, is_chosen }) = (self.most_crossings(), around);
        let found = intersect::selected_self_intersections(mesh, topology, is_chosen, most, self.progress)?;
        let whole =
            |pairs: Vec<[u32; 2]>| pairs.into_iter().map(|p| p.map(|f| numbers[f as usize])).collect();
        Ok(found.map(whole))
    }

    /// Pairs beyond which the mesh is a tangle.
    fn most_crossings(&self) -> usize {
        /// So many pairs are no tangle in any mesh.
        const MIN_CROSSINGS_OF_TANGLE: usize = 10_000;
        MIN_CROSSINGS_OF_TANGLE + 8 * self.state.mesh.faces.len()
    }

    /// All that the check finds of a kind which needs no crossings.
    pub(super) fn find(&mut self, kind: &DefectKind) -> Result<Vec<Finding>, RepairError> {
        let known = self.known()?;
        let default = check::Options::default();
        let island_share = self.options.islands.unwrap_or(default.island_share);
        let options = check::Options { limit: usize::MAX, island_share, ..default };
        let inspected = known.inspected(&self.state.mesh, None, (&options, self.gap), self.progress);
        let found = (kind.find)(&inspected).map_or(vec![], |found| found.items);
        self.go_on()?;
        Ok(found)
    }

    /// Removes facets (numbers in any order, repeated or not) and adds others behind the rest.
    pub(super) fn replace(&mut self, removed: &[u32], added: &[[u32; 3]]) {
        if !removed.is_empty() {
            let mut keep = vec![true; self.state.mesh.faces.len()];
            removed.iter().for_each(|&f| keep[f as usize] = false);
            self.state.pairs.keep(&keep);
            let mut keep = keep.into_iter();
            self.mesh_mut().faces.retain(|_| keep.next().unwrap_or(true));
        }
        if !added.is_empty() {
            self.mesh_mut().faces.extend_from_slice(added);
        }
        self.state.known = None;
    }

    /// Turns facets over.
    pub(super) fn turn(&mut self, facets: impl IntoIterator<Item = u32>) {
        let mesh = self.mesh_mut();
        facets.into_iter().for_each(|f| mesh.faces[f as usize].swap(1, 2));
        self.state.known = None;
        self.state.pairs = Pairs::Unknown;
    }

    /// Lets every corner `v` name `other(facet, v)` instead.
    pub(super) fn rename(&mut self, other: impl Fn(u32, u32) -> u32) {
        for (f, face) in (0..).zip(&mut self.mesh_mut().faces) {
            *face = face.map(|v| other(f, v));
        }
        self.state.known = None;
        self.state.pairs = Pairs::Unknown;
    }

    /// A new vertex at `place`, rounded to single precision where all others are.
    pub(super) fn add(&mut self, place: Point) -> u32 {
        let place = self.rounded(place);
        self.mesh_mut().positions.push(place);
        self.state.known = None;
        self.state.mesh.positions.len() as u32 - 1
    }

    /// New vertices, as they are.
    pub(super) fn append(&mut self, places: &[Point]) {
        self.mesh_mut().positions.extend_from_slice(places);
        self.state.known = None;
    }

    /// `place` in the precision of the mesh.
    pub(super) fn rounded(&self, place: Point) -> Point {
        // Adding zero makes −0 the 0 that a weld would make of it.
        place.map(|x| if self.single { f64::from(x as f32) + 0.0 } else { x + 0.0 })
    }

    /// Forgets facets and vertices that were added behind these and turned out not to be wanted.
    pub(super) fn truncate(&mut self, facets: u32, vertices: usize) {
        let keep: Vec<bool> = (0..self.state.mesh.faces.len()).map(|f| f < facets as usize).collect();
        self.state.pairs.keep(&keep);
        let mesh = self.mesh_mut();
        mesh.faces.truncate(facets as usize);
        mesh.positions.truncate(vertices);
        self.state.known = None;
    }

    /// Removes facets and remembers the rim, so that the hole is filled whatever its size.
    pub(super) fn cut_out(&mut self, removed: &[u32]) {
        let faces = &self.state.mesh.faces;
        self.state.handover.cut_rims.extend(removed.iter().flat_map(|f| faces[*f as usize]));
        self.lose(removed);
    }

    /// Removes facets and remembers where they were.
    pub(super) fn lose(&mut self, removed: &[u32]) {
        self.state.handover.lost.extend(removed.iter().map(|f| self.state.mesh.corners(*f)));
        self.replace(removed, &[]);
    }

    /// Goes back to an earlier state; its vertices must be the first of those now.
    pub(super) fn restore(&mut self, earlier: Arc<Mesh>) {
        self.state.mesh = earlier;
        self.state.known = None;
        self.state.pairs = Pairs::Unknown;
    }

    /// Whether the ring is the rim of a hole that a step has cut.
    pub(super) fn is_own_hole(&self, ring: &[u32]) -> bool {
        ring.iter().all(|v| self.state.handover.cut_rims.contains(v))
    }

    /// Whether a hole that a step has cut is still open.
    pub(super) fn has_open_cut(&mut self) -> Result<bool, RepairError> {
        Ok(self.known()?.boundary.rings.iter().any(|ring| self.is_own_hole(ring)))
    }

    pub(super) fn log(
        &mut self,
        step: &'static Step,
        what: &'static str,
        position: Point,
        facets: usize,
        size: f64,
    ) {
        self.state.changes.push(Change { step, what, position, facets, size });
    }
}
