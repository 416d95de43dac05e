//! Exchange structures of ISO 10303-21: the entities of a file and their parameters, parsed in one pass.
//!
//! A damaged entity does no harm to others: it is remembered with its reason, and reading goes on at the next one. Time and
//! memory are proportional to the length of the text, whatever it holds.

mod file;
mod lines;
mod pages;
mod record;
mod scan;
#[cfg(test)]
mod tests;
mod text;
mod value;

pub(super) use crate::formats::brep::Wrong;
pub(super) use file::{Entity, File};
pub(super) use record::Record;
pub(super) use scan::parse;
pub(super) use value::Value;
