//! What other robots run, in the forms of trees.

use crate::program::NoFiles;
use crate::snapshot;
use btc::driver::compile::{self, Form};
use btc::driver::load::load;
use btc::emit::form::TreeForm;

#[test]
fn the_tree_of_another_robot_has_every_form() {
    let program = include_str!("../../cases/refused/runs_the_script_of_another_robot/yard.bt");
    let loaded = load("yard.bt", program.into(), &mut NoFiles);
    assert!(!loaded.has_errors());
    let written = |form| compile::emit(&loaded, Form::Tree(form), Some("patrol")).unwrap();
    let texts = [TreeForm::Bt, TreeForm::Dot, TreeForm::Json, TreeForm::BtCpp];
    snapshot::check("script.forms", &texts.map(written).join("\n"));
    for form in [TreeForm::Svg, TreeForm::PyTrees] {
        assert!(written(form).contains("goto"), "{form:?}");
    }
}
