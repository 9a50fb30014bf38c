//! The rules of the format, as BehaviorTree.CPP checks them and Groot2 needs them.

use super::file::{self, inside, only};
use super::trees::{Grower, Kinds, atoms, subjects};
use super::{names, written};
use crate::examples;
use crate::laws::build::selector;
use crate::laws::random::Random;
use crate::program::called;
use btc::driver::compile;
use btc::driver::compile::Form;
use btc::emit::btcpp::RESERVED;
use btc::emit::form::TreeForm;
use btc::ir::Program;
use btc::ir::law::Behavior;
use btc::ir::program::Predicate;
use roxmltree::{Document, Node as Element};
use std::collections::BTreeSet;

const CONTROLS: [&str; 6] = [
    "AsyncSequence",
    "Fallback",
    "Parallel",
    "ReactiveFallback",
    "ReactiveSequence",
    "Sequence",
];
/// The decorators, each with its ports.
const DECORATORS: [(&str, &[&str]); 6] = [
    ("ForceFailure", &[]),
    ("ForceSuccess", &[]),
    ("Inverter", &[]),
    ("Repeat", &["num_cycles"]),
    ("RetryUntilSuccessful", &["num_attempts"]),
    ("Timeout", &["msec"]),
];

fn is_legal(id: &str) -> bool {
    !id.is_empty()
        && id.starts_with(|c: char| c.is_ascii_alphabetic())
        && !id.contains(|c: char| c.is_whitespace() || "<>&\"'/\\:*?|.".contains(c))
}

/// Checks a file against every rule.
fn check(text: &str) {
    let document = Document::parse(text).unwrap_or_else(|error| panic!("{error}: {text}"));
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "root");
    assert_eq!(root.attribute("BTCPP_format"), Some("4"));
    let main = root.attribute("main_tree_to_execute").unwrap();
    let trees: Vec<Element> = inside(root)
        .into_iter()
        .filter(|e| e.has_tag_name("BehaviorTree"))
        .collect();
    let ids: Vec<&str> = trees.iter().map(|t| t.attribute("ID").unwrap()).collect();
    assert_eq!(ids, [main]);
    assert!(is_legal(main) && !RESERVED.contains(&main), "{main}");

    let model = only(&document, "TreeNodesModel");
    let mut modelled = BTreeSet::new();
    for entry in inside(model) {
        assert!(["Action", "Condition"].contains(&entry.tag_name().name()));
        let id = entry.attribute("ID").unwrap();
        assert!(is_legal(id) && !RESERVED.contains(&id), "{id}");
        assert_ne!(id, main);
        assert!(modelled.insert(id), "{id} twice");
    }

    let mut used = BTreeSet::new();
    assert_eq!(inside(trees[0]).len(), 1, "{text}");
    for node in trees[0]
        .descendants()
        .skip(1)
        .filter(|node| node.is_element())
    {
        let (tag, children) = (node.tag_name().name(), inside(node).len());
        if CONTROLS.contains(&tag) {
            assert!(children > 0, "{text}");
            if tag == "Parallel" {
                let count = |name| node.attribute(name).unwrap().parse::<usize>().unwrap();
                let (successes, failures) = (count("success_count"), count("failure_count"));
                assert_eq!(successes + failures, children + 1);
            }
        } else if let Some((_, ports)) = DECORATORS.iter().find(|(name, _)| *name == tag) {
            assert_eq!(children, 1, "{text}");
            let given: Vec<&str> = node.attributes().map(|a| a.name()).collect();
            assert_eq!(given, *ports);
            for attribute in node.attributes() {
                attribute.value().parse::<u32>().unwrap();
            }
        } else if ["Script", "ScriptCondition"].contains(&tag) {
            let given: Vec<&str> = node.attributes().map(|a| a.name()).collect();
            assert_eq!((children, given), (0, vec!["code"]));
        } else if ["AlwaysSuccess", "AlwaysFailure"].contains(&tag) {
            assert_eq!(children, 0);
        } else {
            assert_eq!(children, 0);
            used.insert(tag);
            let entry = inside(model)
                .into_iter()
                .find(|e| e.attribute("ID") == Some(tag));
            let entry = entry.unwrap_or_else(|| panic!("{tag} has no model: {text}"));
            let ports: Vec<&str> = inside(entry)
                .iter()
                .map(|port| port.attribute("name").unwrap())
                .collect();
            let library = ["name", "_onSuccess", "_onFailure"];
            for attribute in node.attributes().filter(|a| !library.contains(&a.name())) {
                assert!(ports.contains(&attribute.name()), "{text}");
                // In braces it would be an entry of the blackboard.
                assert!(!attribute.value().starts_with('{'), "{text}");
            }
            for port in ports {
                assert!(is_legal(port) && !["ID", "name"].contains(&port), "{port}");
            }
        }
    }
    assert_eq!(used, modelled, "{text}");
}

#[test]
fn of_examples() {
    for name in examples::names() {
        let loaded = examples::example(&name);
        for tree in loaded.program.trees.values() {
            let form = Form::Tree(TreeForm::BtCpp);
            check(&compile::emit(&loaded, form, Some(&tree.name.to_string())).unwrap());
        }
    }
}

#[test]
fn of_random_trees() {
    let loaded = names();
    let program = &loaded.program;
    let form = Form::Tree(TreeForm::BtCpp);
    check(&compile::emit(&loaded, form, Some("everything")).unwrap());
    for seed in 0..500 {
        let mut grower = Grower {
            random: &mut Random::new(seed),
            atoms: &atoms(program),
            behaviors: program.behaviors.len(),
            kinds: Kinds {
                counters: true,
                timeouts: true,
                all: true,
            },
        };
        let root = match seed % 2 {
            0 => grower.plain(4),
            _ => grower.learned(2),
        };
        check(&written(program, &root, TreeForm::BtCpp).unwrap());
    }
}

/// Names of foreign tables, some of them half calls, some alike but for what an id cannot say.
#[test]
fn of_names_from_anywhere() {
    let mut program = Program::default();
    let odd = [
        "x",
        "`x y`",
        "`x-y`",
        "x_y",
        "`x(y)`",
        "x(y)",
        "x(`y)`)",
        "x(y",
        "x()",
        "x(y, z)",
        "x(y,)",
        "``",
        "`1`",
        "`é`",
        "`\u{1}\u{7f}\u{fffe}`",
        "root",
        "`name`",
        "`a\tb`",
        "tried",
        "x(z = y)",
        "class",
        "`--`",
        "f({y})",
    ];
    for name in odd {
        let name = called(name);
        program.behaviors.push(Behavior {
            name: name.clone(),
            law: None,
        });
        program.predicates.push(Predicate { name, when: None });
    }
    // Each leaf has a way of its own to be written.
    assert_eq!(file::leaves(&program).len(), 4 * odd.len());
    let (asked, done) = subjects(&program);
    let all = selector(asked.into_iter().chain(done).collect());
    check(&written(&program, &all, TreeForm::BtCpp).unwrap());
    assert!(written(&program, &all, TreeForm::PyTrees).is_ok());
}
