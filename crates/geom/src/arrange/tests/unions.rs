//! Unions with a known volume.
use super::super::*;
