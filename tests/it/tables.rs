//! Policy tables of any origin: what is told of wrong ones, what is made of good ones, and what holds of all.

mod canonical;
mod cases;
mod command;
mod games;
mod laws;
mod sets;
mod slack;
mod values;

use btc::diagnostic::render;
use btc::driver::decanonicalize::{self, Made, Options};
use btc::driver::load::{Loaded, load};
use btc::driver::table::Recorded;
use btc::driver::verify::{self, Proved};
use btc::driver::{Refused, Text};
use btc::emit::form::TreeForm;
use btc::tree::decanonicalise::{Method, Order};

use crate::program::{self, NoFiles};

/// What `btc decanonicalize` does if nothing is said.
pub(crate) const USUAL: Options = Options {
    method: Method::Search,
    order: Order::Learned,
    effort: 10,
    slack: 0.0,
    from: None,
    name: "learned",
    form: TreeForm::Bt,
};

fn text<'t>(name: &'t str, bytes: &'t [u8]) -> Text<'t> {
    Text { name, bytes }
}

/// What is made of a table.
fn made(table: Text, recorded: Option<Recorded>, options: &Options) -> Result<Made, Refused> {
    let asked = decanonicalize::read(table, recorded, None, options)?;
    decanonicalize::decanonicalize(asked, options)
}

/// What a person is shown of a table that is refused.
fn shown(refused: &Refused) -> String {
    render::human(&refused.sources, &refused.diagnostics, false)
}

/// The program that was made, which has no mistakes.
fn loaded(made: &Made) -> Loaded {
    let loaded = load("made.bt", made.text.clone().into(), &mut NoFiles);
    assert_eq!(program::shown(&loaded), "", "{}", made.text);
    loaded
}

/// What comes of a comparison of the tree that was made with a table.
fn compared(made: &Made, table: Text) -> Proved {
    verify::table(&loaded(made), "learned", (table, None), None)
        .unwrap_or_else(|r| panic!("{}", shown(&r)))
}

/// A table whose first row is another than that of the tree's is refuted, by its line.
fn is_found(made: &Made, table: &str) {
    let refuted = compared(made, text("other.csv", table.as_bytes()));
    assert!(!refuted.holds());
    assert!(refuted.text.contains("other.csv:2: "), "{}", refuted.text);
}
