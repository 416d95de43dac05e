//! What an alignment must do, against closed forms, brute force and properties.

mod parts;
mod poses;
mod rows;
