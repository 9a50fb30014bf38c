//! search
use super::problem::Problem;
use crate::ir::tree::Node;
pub(super) fn tree(_problem: &Problem, paper: &Node) -> Node {
    paper.clone()
}
