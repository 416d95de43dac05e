//! The contract of an alignment, against closed forms, brute force and properties.

mod asked;
mod coverage;
mod field;
mod flat;
mod loose;
mod minimax;
mod mirror;
mod parts;
mod poses;
mod response;
mod revolved;
mod rows;
mod wall;
mod zones;
