//! One file a command.

pub mod compare;
