//! A robot has one interface of leaves, whichever way a tree came to it.

use super::file::{inside, only};
use crate::examples::example;
use crate::program;
use btc::driver::Text;
use btc::driver::compile::{self, Form};
use btc::driver::decanonicalize::{self, Named, Options, decanonicalize};
use btc::emit::form::TreeForm;
use roxmltree::{Document, Node as Element};
use std::collections::BTreeSet;
use std::path::Path;

/// What a task of the small delivery has decided; each atom is asked, and each behaviour done.
const TABLE: &str = "\
carrying_package,battery_low,done(goto(C)),behavior
0,0,-,goto(A)
1,0,-,goto(B)
-,1,0,goto(C)
-,1,1,dock(C)
";

/// The table as a tree in a form.
fn made(named: Option<Named>, form: TreeForm) -> String {
    let options = Options {
        form,
        ..Options::default()
    };
    let table = Text {
        name: "policy.csv",
        bytes: TABLE.as_bytes(),
    };
    let asked = decanonicalize::read(table, None, named, &options).unwrap();
    decanonicalize(asked, &options).unwrap().text
}

/// An element with its attributes and what is inside.
fn written(element: Element) -> String {
    let attributes = element.attributes();
    let attributes = attributes.map(|found| format!(" {}={}", found.name(), found.value()));
    let inside: String = inside(element).into_iter().map(written).collect();
    format!(
        "<{}{}>{inside}",
        element.tag_name().name(),
        attributes.collect::<String>()
    )
}

/// What a file of BehaviorTree.CPP has the robot register, and how its leaves are called.
fn interface(file: &str) -> (BTreeSet<String>, BTreeSet<String>) {
    let document = Document::parse(file).unwrap();
    let model = only(&document, "TreeNodesModel");
    let ids = ["goto", "dock", "battery_low", "carrying_package", "done"];
    let leaves = only(&document, "BehaviorTree").descendants();
    let leaves = leaves.filter(|node| ids.contains(&node.tag_name().name()));
    let model = inside(model).into_iter().map(written);
    (model.collect(), leaves.map(written).collect())
}

#[test]
fn a_table_of_a_program_has_the_leaves_of_its_trees() {
    let source = example("delivery_small");
    let named = Named {
        loaded: &source,
        path: None,
    };
    let direct = made(Some(named), TreeForm::BtCpp);
    assert!(direct.contains("<BehaviorTree ID=\"delivery_small_learned\">"));
    // The tree in the language, behind its program.
    let path = Path::new("delivery_small.bt");
    let loaded = program::with_text(path, made(Some(named), TreeForm::Bt));
    assert_eq!(program::shown(&loaded), "");
    let form = Form::Tree(TreeForm::BtCpp);
    let compiled = compile::emit(&loaded, form, Some("learned")).unwrap();
    assert_eq!(interface(&direct), interface(&compiled));
    // The tree of the program asks no history; all else it has alike.
    let expert = compile::emit(&loaded, form, Some("expert")).unwrap();
    let (model, _) = interface(&direct);
    let (of_expert, leaves) = interface(&expert);
    let more: Vec<&String> = model.difference(&of_expert).collect();
    assert_eq!(more.len(), 1, "{more:?}");
    assert!(more[0].starts_with("<Condition ID=done>"), "{more:?}");
    assert!(model.is_superset(&of_expert), "{of_expert:?}");
    assert!(leaves.contains("<goto target=C>"), "{leaves:?}");
}

#[test]
fn a_word_of_a_table_is_the_call_that_it_spells() {
    let direct = made(None, TreeForm::BtCpp);
    let (model, leaves) = interface(&direct);
    assert_eq!(model.len(), 5, "{model:?}");
    assert!(
        leaves.contains("<goto name=goto(C) argument_1=C>"),
        "{leaves:?}"
    );
    assert!(leaves.contains("<done behavior=goto(C)>"), "{leaves:?}");
    let declared = program::with_text(Path::new("made.bt"), made(None, TreeForm::Bt));
    assert_eq!(program::shown(&declared), "");
    for form in [TreeForm::BtCpp, TreeForm::BtCppHistory, TreeForm::PyTrees] {
        let compiled = compile::emit(&declared, Form::Tree(form), Some("learned")).unwrap();
        assert_eq!(compiled, made(None, form));
    }
}

/// The history comes with a tree that asks it, with what the task says of the window.
#[test]
fn the_history_comes_with_the_tree() {
    let source = example("delivery_small");
    let named = Named {
        loaded: &source,
        path: None,
    };
    for (form, name) in [
        (TreeForm::BtCppHistory, "delivery_small.learned.hpp"),
        (TreeForm::PyTrees, "delivery_small.learned.py"),
    ] {
        crate::snapshot::check(name, &made(Some(named), form));
    }
    // Without a task, nobody knows the window.
    let unknown =
        "explicit History(BT::BehaviorTreeFactory& factory, std::size_t last, Statuses of)";
    assert!(made(None, TreeForm::BtCppHistory).contains(unknown));
    let module = made(None, TreeForm::PyTrees);
    assert!(module.contains("def create_root(robot: Robot, history: History) -> Behaviour:"));
    assert!(module.contains("def __init__(self, last: int, of: Container[Status]) -> None:"));
}
