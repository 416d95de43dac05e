//! 3D inspection as a library: what the program `trueness` does, from files, uploads or memory.
//!
//! Lengths are millimeters, angles radians, deviations positive outside of the material. Answers are the same for any number of threads.
//!
//! | task | where |
//! |---|---|
//! | read a file of any kind; write a mesh | [`read`](read()), [`write_mesh`] |
//! | signed deviations of points from a mesh or from the exact faces of a CAD model, their statistics | [`Reference`], [`Deviations`] |
//! | a CAD model from memory, asked with other options each time | [`Model`] |
//! | bring a scan onto its reference | [`Reference::align`] |
//! | is a mesh sound? | [`check`] |
//! | mend it | [`repair`] |
//! | planes, circles, cylinders … of least squares | [`fit`] |
//! | planes, cylinders … found in a scan | [`segment`] |
//! | lines, arcs and curves of a profile | [`contour`] |
//! | the same where a plane cuts a mesh | [`sections`] |
//! | a B-spline surface through points | [`surface`](surface()) |
//! | curvatures of a mesh | [`curvature`] |
//! | what each command of the program does, from files or memory, with document, page and outcome | [`tasks`] |
//! | an inspection plan: features, characteristics, verdicts | [`tasks::inspect`] |
//! | results as values and JSON; the text of plans | [`document`] |
//! | a result as a page with pictures, one HTML file | [`report::write`](report::write()) |
//! | who hears how far a task is, and may stop it; what it reads from memory | [`task::Watch`], [`files::MemorySources`] |
//! | everything else, with all options | [`geom`], [`section`](mod@section), [`solid`], [`surface`](mod@surface), [`cad`], [`files`], [`measure`] |
//!
//! The functions here take the defaults and tell nobody how far they are. The functions of the same names in the crates of geometry take options, and a
//! [`Progress`](geom::progress::Progress) that is told and may stop them.
//!
//! ```
//! use trueness::{Reference, read};
//! let reference = Reference::read("../../corpus/bunny/zipper_res4.ply")?;
//! let scan = read("../../corpus/bunny/zipper_res3.ply")?;
//! let deviations = reference.deviations(scan.points())?;
//! let statistics = deviations.statistics();
//! assert_eq!(statistics.all.count, 1887);
//! assert!((statistics.all.rms? - 1.376).abs() < 0.001);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A task answers with a document, which is JSON, and a page:
//! ```
//! use trueness::report::ReportOptions;
//! use trueness::task::{Outcome, Request};
//! use trueness::{files::FileSources, geom::progress::Silent, tasks::compare::CompareRequest};
//! let request = CompareRequest {
//!     measured: "../../corpus/bunny/zipper_res3.ply".into(),
//!     references: vec!["../../corpus/bunny/zipper_res4.ply".into()],
//!     tolerance: Some("-0.5,+0.5".parse()?),
//!     view: true,
//!     ..CompareRequest::default()
//! };
//! let done = request.run(&FileSources, &Silent)?;
//! assert_eq!(done.outcome, Outcome::NotConforming);
//! let page = done.report(&ReportOptions::default(), &Silent)?;
//! assert!(page.starts_with(b"<!doctype html>"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod easy;
mod read;
pub mod task;
pub mod tasks;

pub use easy::deviations::{Deviation, Deviations};
pub use easy::error::Error;
pub use easy::model::Model;
pub use easy::part::{Part, read, write_mesh};
pub use easy::reference::Reference;
pub use easy::tasks::{check, contour, curvature, fit, repair, sections, segment, surface};

pub use trueness_cad as cad;
pub use trueness_document as document;
pub use trueness_files as files;
pub use trueness_geom as geom;
pub use trueness_measure as measure;
pub use trueness_report as report;
pub use trueness_section as section;
pub use trueness_solid as solid;
pub use trueness_surface as surface;

pub use trueness_geom::align::Alignment;
pub use trueness_geom::check::Report;
pub use trueness_geom::closest::Closest;
pub use trueness_geom::deviation::sign_choice::{SignChoice, SignRequest};
pub use trueness_geom::deviation::surface::{Exclusion, SurfaceOptions};
pub use trueness_geom::fit::Fit;
pub use trueness_geom::mesh::Mesh;
pub use trueness_geom::plane::Plane;
pub use trueness_geom::segment::Segmentation;
pub use trueness_geom::shape::{Kind, Shape};
pub use trueness_geom::space::{Point, Vector};
pub use trueness_geom::stats::statistics::{Missing, Statistics, Summary};
pub use trueness_section::Contour;
pub use trueness_solid::repair::Repaired;
pub use trueness_surface::SurfaceFit;
pub use trueness_surface::curvature::Curvatures;
