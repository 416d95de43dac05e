//! What an alignment must do, against closed forms, brute force and properties.

mod field;
mod flat;
mod minimax;
mod parts;
mod poses;
mod response;
mod revolved;
mod rows;
mod wall;
mod zones;
