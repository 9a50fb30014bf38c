//! The history window for BehaviorTree.CPP 4: a header of C++, which answers what the tree asks by `done` and `failed`.
//!
//! It notes how behaviours end by their changes of status, so that no behaviour has to do anything for it.

use super::btcpp::RESERVED;
use super::calls;
use super::leaves::{Leaves, Words};
use super::notes;
use crate::ir::Program;
use crate::ir::task::History;
use crate::ir::tree::{Status, Tree};

const HEADER: &str = include_str!("history.hpp");

/// The history that a tree asks, as a header of C++.
pub fn header(program: &Program, tree: &Tree) -> String {
    let program = &*calls::called(program);
    let leaves = Leaves::of(tree, program, &mut Words::new(RESERVED));
    let history = tree.task.map(|task| program.tasks[task].history);
    let behaviors = leaves.actions().map(|family| format!("\"{}\"", family.id));
    let behaviors: Vec<String> = behaviors.collect();
    let name = tree.name.family.replace(char::is_control, " ");
    HEADER
        .replace("{constructor}", &constructor(history))
        .replace("{held}", &notes::held(history))
        .replace("{behaviors}", &format!("{{{}}}", behaviors.join(", ")))
        .replace("{tree}", &name)
}

/// What is not known of the window has to be given.
fn constructor(history: Option<History>) -> String {
    let (last, of) = match history {
        Some(history) => {
            let kinds = notes::kinds(history).map(|status| match status {
                Status::Success => "BT::NodeStatus::SUCCESS",
                _ => "BT::NodeStatus::FAILURE",
            });
            let kinds: Vec<&str> = kinds.collect();
            let of = format!(" = {{{}}}", kinds.join(", "));
            (format!(" = {}", history.window), of)
        }
        None => (String::new(), String::new()),
    };
    format!(
        "explicit History(BT::BehaviorTreeFactory& factory, std::size_t last{last}, Statuses of{of})"
    )
}
