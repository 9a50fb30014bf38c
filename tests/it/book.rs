//! The book, `docs/book`: what it shows is what btc does.
//!
//! Some of it is made: pages as a whole (`made`), and what commands print (`told`). The tests fail where that is out of date;
//! `UPDATE_BOOK=1 cargo test --test it book:: -- --include-ignored` writes it anew.

pub(crate) mod pages;

mod links;
mod made;
mod theme;
#[cfg(unix)]
mod told;
