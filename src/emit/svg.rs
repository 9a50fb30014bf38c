//! Pictures as SVG: a tree, a world with the way of its robot, a learning curve.
//!
//! A picture needs nothing but itself: no fonts, no scripts, no other files. It has a title and a description for those
//! who cannot see it, and follows the light or dark scheme of the page around it. The same input gives the same bytes.

mod chart;
pub mod curve;
pub mod front;
pub mod layout;
mod legend;
mod page;
mod paint;
mod scale;
pub mod sweep;
pub mod track;
pub mod tree;
mod view;
pub mod world;
