//! What all tasks have in common: what they are asked, what they read from, whom they tell, and what they answer.
//!
//! A task is a function of a request and of what its names stand for. It writes nothing in its place: files that were asked for lie
//! unfinished beside their places until [`Done::commit`].

mod choice;
mod done;
mod error;
mod files;
mod noise;
mod numbers;
mod output;
mod reading;
mod request;
mod text;
mod tolerance;
mod watch;

pub use choice::Choice;
pub(crate) use choice::choices;
pub use done::{Done, Outcome, Page, REPORT_POINTS, Rounding, Scene};
pub use error::{ErrorKind, Meaning, TaskError, causes};
pub use files::RunFiles;
pub use noise::Independence;
pub(crate) use numbers::{above_zero, not_negative, share_of_percent, up_to};
pub use output::{Output, json, whole_file};
pub use reading::{PointReading, Reading, ReferenceReading, welding};
pub use request::Request;
pub use text::{FormatName, Text};
pub use tolerance::{NoTolerance, ToleranceText};
pub use watch::{STEPS, Stage, Watch, ended};
