//! A policy whose rows have little in common at first sight: the moves of a player of tic-tac-toe.

use super::{USUAL, compared, made, text};
use btc::driver::decanonicalize::Options;
use btc::tree::Size;
use std::collections::{BTreeMap, BTreeSet};

const LINES: [[usize; 3]; 8] = [
    [0, 1, 2],
    [3, 4, 5],
    [6, 7, 8],
    [0, 3, 6],
    [1, 4, 7],
    [2, 5, 8],
    [0, 4, 8],
    [2, 4, 6],
];

/// Which cells the player prefers: the middle, the corners, the rest.
const PREFERRED: [usize; 9] = [4, 0, 2, 6, 8, 1, 3, 5, 7];

/// The most nodes: the player's rules as a tree, two for each line and the cell that completes it.
const BY_HAND: usize = 418;

type Board = [char; 9];

fn is_won(board: &Board) -> bool {
    LINES.iter().any(|line| {
        let [a, b, c] = line.map(|cell| board[cell]);
        a != 'e' && a == b && b == c
    })
}

/// The player completes a line, or else keeps the other one from it, or else takes the cell that it prefers.
fn chosen(board: &Board) -> usize {
    for player in ['x', 'o'] {
        for line in LINES {
            let own = line.iter().filter(|cell| board[**cell] == player).count();
            let free = line.iter().find(|cell| board[**cell] == 'e');
            if let (2, Some(free)) = (own, free) {
                return *free;
            }
        }
    }
    PREFERRED
        .into_iter()
        .find(|cell| board[*cell] == 'e')
        .unwrap()
}

/// The moves on all boards that come up, whatever both players do.
fn moves() -> BTreeMap<Board, usize> {
    let mut moves = BTreeMap::new();
    let mut seen: BTreeSet<(Board, char)> = BTreeSet::new();
    let mut due = vec![(['e'; 9], 'x')];
    while let Some((board, player)) = due.pop() {
        if is_won(&board) || !board.contains(&'e') || !seen.insert((board, player)) {
            continue;
        }
        if player == 'x' {
            moves.insert(board, chosen(&board));
        }
        for cell in (0..9).filter(|cell| board[*cell] == 'e') {
            let mut next = board;
            next[cell] = player;
            due.push((next, if player == 'x' { 'o' } else { 'x' }));
        }
    }
    moves
}

/// However little effort there is beyond a first list, the tree is no larger than the rules that the moves come from.
#[test]
fn rules_of_a_game_are_found_at_any_effort() {
    let header: Vec<String> = (0..9)
        .map(|cell| format!("\"c{cell}:{{x,o,e}}\""))
        .collect();
    let mut table = format!("{},behavior\n", header.join(","));
    let moves = moves();
    assert_eq!(moves.len(), 2423);
    for (board, cell) in &moves {
        let cells: Vec<String> = board.iter().map(char::to_string).collect();
        table += &format!("{},p{cell}\n", cells.join(","));
    }
    let table = text("moves.csv", table.as_bytes());
    for effort in [5, 10, 20, 30] {
        let options = Options { effort, ..USUAL };
        let made = made(table, None, &options).unwrap();
        let nodes = Size::of(&made.program.trees[made.tree].root).nodes;
        assert!(nodes <= BY_HAND, "{nodes} nodes at effort {effort}");
        assert!(compared(&made, table).holds());
    }
}
