//! A file of BehaviorTree.CPP as its reader sees it, and what its leaves are.

use super::trees::subjects;
use super::written;
use btc::emit::form::TreeForm;
use btc::ir::Program;
use btc::ir::tree::{Atom, Node};
use roxmltree::{Document, Node as Element};
use std::collections::BTreeMap;

/// A leaf as it is written: its id and its ports.
pub(super) type Leaf = (String, BTreeMap<String, String>);

/// The leaf of an element; its name is for people, and what begins with `_` the library does for every node.
pub(super) fn leaf(element: Element) -> Leaf {
    let own = |name: &str| name == "name" || name.starts_with('_');
    let ports = element.attributes().filter(|a| !own(a.name()));
    let ports = ports.map(|a| (a.name().to_owned(), a.value().to_owned()));
    (element.tag_name().name().to_owned(), ports.collect())
}

/// The elements inside an element.
pub(super) fn inside<'a, 'i>(element: Element<'a, 'i>) -> Vec<Element<'a, 'i>> {
    element
        .children()
        .filter(|child| child.is_element())
        .collect()
}

/// The only element of that name.
pub(super) fn only<'a, 'i>(document: &'a Document<'i>, name: &str) -> Element<'a, 'i> {
    let mut found = document.descendants().filter(|e| e.has_tag_name(name));
    let first = found.next().unwrap();
    assert!(found.next().is_none(), "two <{name}>");
    first
}

/// Whether a leaf is of a robot that runs a script: no tree of the program has it.
pub(super) fn is_of_another_robot(program: &Program, leaf: &Node) -> bool {
    let mut found = false;
    leaf.visit_behaviors(&mut |id| found |= program.behaviors[id].name.robot().is_some());
    leaf.visit_atoms(&mut |atom| {
        let name = match atom {
            Atom::Predicate(id) => &program.predicates[id].name,
            Atom::Done(id) | Atom::Failed(id) => &program.behaviors[id].name,
        };
        found |= name.robot().is_some();
    });
    found
}

/// How conditions (by atom) and behaviours are written in files of their own.
pub(super) fn leaves(program: &Program) -> BTreeMap<Leaf, (bool, usize)> {
    let (asked, done) = subjects(program);
    let mut leaves = BTreeMap::new();
    for (acts, nodes) in [(false, asked), (true, done)] {
        for (i, node) in nodes.iter().enumerate() {
            if is_of_another_robot(program, node) {
                continue;
            }
            let text = written(program, node, TreeForm::BtCpp).unwrap();
            let document = Document::parse(&text).unwrap();
            let root = inside(only(&document, "BehaviorTree"));
            let twice = leaves.insert(leaf(root[0]), (acts, i));
            assert_eq!(twice, None, "{text}");
        }
    }
    leaves
}
