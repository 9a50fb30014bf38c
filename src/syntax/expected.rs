//! What could have stood at a place, in the words of a person.

use super::grammar::Rule;

/// Where an expectation comes in a list; the lower, the more useful.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    /// A bracket, a comma, a colon: most often forgotten.
    Mark,
    /// A word that must come.
    Word,
    /// A name, a value, a block.
    Part,
    /// What may follow, but need not.
    More,
}

/// How many expectations a message lists at most.
const LISTED: usize = 4;

/// The expectations as a list: "`,`, `)` or an operator"; nothing if there are none to name.
///
/// After an entry that could have ended, the next one of `strict` could begin as well, which says nothing.
pub(super) fn listed(rules: &[Rule], strict: Option<Rule>) -> Option<String> {
    let begins = strict.map_or(&[] as &[&str], beginnings);
    let is_next = |rule: Rule| name(rule).is_some_and(|(_, word)| begins.contains(&word));
    let could_end = rules.iter().filter(|&&rule| is_next(rule)).count() >= 2;
    let has_operator = rules
        .iter()
        .any(|&rule| name(rule) == Some((Rank::More, "an operator")));
    let told = rules.iter().filter(|&&rule| {
        let is_call = has_operator && rule == Rule::open_paren;
        !(is_call || could_end && is_next(rule))
    });
    let mut named: Vec<(Rank, &str)> = told.filter_map(|&rule| name(rule)).collect();
    named.sort();
    named.dedup();
    if named.len() > 1 && named.iter().any(|&(rank, _)| rank < Rank::More) {
        let must: Vec<_> = named
            .iter()
            .copied()
            .filter(|&(rank, _)| rank < Rank::More)
            .collect();
        if must.len() >= LISTED {
            named = must;
        }
    }
    let words: Vec<&str> = named.into_iter().map(|(_, word)| word).collect();
    let (last, first) = words.split_last()?;
    if first.is_empty() && !last.contains(", ") {
        return Some((*last).to_owned());
    }
    if words.len() > LISTED + 1 {
        let first = words.get(..LISTED).unwrap_or_default().join(", ");
        return Some(format!("{first} or something like it"));
    }
    let (last, more) = match last.rsplit_once(", ") {
        Some((more, last)) => (last, Some(more)),
        None => (*last, None),
    };
    let all: Vec<&str> = first.iter().copied().chain(more).collect();
    Some(format!("{} or {last}", all.join(", ")))
}

/// What begins an entry of a block, as the messages call it.
fn beginnings(strict: Rule) -> &'static [&'static str] {
    match strict {
        Rule::strict_item => &[
            "`use`",
            "`world`",
            "`enum`",
            "`input`",
            "`state`",
            "`event`",
            "`each`",
            "`on`",
            "`let`",
            "`predicate`",
            "`behavior`",
            "`task`",
            "`learn`",
            "`tree`",
            "`claim`",
            "`test`",
        ],
        Rule::strict_world_entry => &["`place`", "`wall`", "`robot`", "a name"],
        Rule::strict_robot_entry => &["`sensor`", "a name"],
        Rule::strict_clause => &["`local`", "`requires`", "`succeed`", "`fail`", "`control`"],
        Rule::strict_aspect => &[
            "`observe`",
            "`choose`",
            "`history`",
            "`patience`",
            "`start`",
            "`end`",
            "`reward`",
        ],
        Rule::strict_reward => &["`on`", "`while`", "`per`", "`otherwise`"],
        Rule::strict_learn_entry => &["`start`", "a name"],
        Rule::strict_test_entry => &["`given`", "`tick`"],
        Rule::strict_stmt => &["`let`", "`for`", "`if`", "a name", "a statement"],
        _ => &[],
    }
}

/// The words that could have stood there.
pub(super) fn words(rules: &[Rule]) -> Vec<&'static str> {
    rules
        .iter()
        .filter_map(|&rule| name(rule))
        .filter(|(rank, _)| *rank == Rank::Word)
        .map(|(_, word)| word.trim_matches('`'))
        .collect()
}

/// What a person would call a production; nothing for those that nobody would write on purpose.
fn name(rule: Rule) -> Option<(Rank, &'static str)> {
    use Rank::{Mark, More, Part, Word};
    Some(match rule {
        Rule::use_item | Rule::kw_use => (Word, "`use`"),
        Rule::world | Rule::kw_world => (Word, "`world`"),
        Rule::enum_item | Rule::kw_enum => (Word, "`enum`"),
        Rule::input | Rule::kw_input => (Word, "`input`"),
        Rule::state | Rule::kw_state => (Word, "`state`"),
        Rule::event | Rule::kw_event => (Word, "`event`"),
        Rule::each_tick | Rule::kw_each => (Word, "`each`"),
        Rule::on_item | Rule::reward_line | Rule::kw_on => (Word, "`on`"),
        Rule::let_item | Rule::binding | Rule::kw_let => (Word, "`let`"),
        Rule::predicate | Rule::kw_predicate => (Word, "`predicate`"),
        Rule::behavior | Rule::kw_behavior => (Word, "`behavior`"),
        Rule::task | Rule::kw_task => (Word, "`task`"),
        Rule::learn | Rule::kw_learn => (Word, "`learn`"),
        Rule::tree | Rule::kw_tree => (Word, "`tree`"),
        Rule::claim | Rule::kw_claim => (Word, "`claim`"),
        Rule::kw_if => (Word, "`if`"),
        Rule::kw_else | Rule::branch_else | Rule::choice_else => (Word, "`else`"),
        Rule::kw_for => (Word, "`for`"),
        Rule::kw_in => (Word, "`in`"),
        Rule::kw_tick => (Word, "`tick`"),
        Rule::place | Rule::kw_place => (Word, "`place`"),
        Rule::wall | Rule::kw_wall => (Word, "`wall`"),
        Rule::robot | Rule::kw_robot => (Word, "`robot`"),
        Rule::sensor | Rule::kw_sensor => (Word, "`sensor`"),
        Rule::kw_facing => (More, "`facing`"),
        Rule::kw_wall_when => (More, "`when`"),
        Rule::kw_when => (Word, "`when`"),
        Rule::local | Rule::kw_local => (Word, "`local`"),
        Rule::requires | Rule::kw_requires => (Word, "`requires`"),
        Rule::succeed_when | Rule::kw_succeed => (Word, "`succeed`"),
        Rule::fail_when | Rule::kw_fail => (Word, "`fail`"),
        Rule::control | Rule::kw_control => (Word, "`control`"),
        Rule::observe | Rule::kw_observe => (Word, "`observe`"),
        Rule::choose | Rule::kw_choose => (Word, "`choose`"),
        Rule::history | Rule::kw_history => (Word, "`history`"),
        Rule::kw_last => (Word, "`last`"),
        Rule::patience | Rule::kw_patience => (Word, "`patience`"),
        Rule::start | Rule::kw_start => (Word, "`start`"),
        Rule::end_on | Rule::end_after | Rule::kw_end => (Word, "`end`"),
        Rule::kw_after => (Word, "`after`"),
        Rule::reward | Rule::kw_reward => (Word, "`reward`"),
        Rule::otherwise | Rule::kw_otherwise => (Word, "`otherwise`"),
        Rule::price_line | Rule::kw_per => (Word, "`per`"),
        Rule::kw_while => (Word, "`while`"),
        Rule::kw_memory => (More, "`memory`"),
        Rule::claim_equals | Rule::kw_equals => (Word, "`equals`"),
        Rule::claim_never | Rule::kw_never => (Word, "`never`"),
        Rule::claim_reaches | Rule::kw_reaches => (Word, "`reaches`"),
        Rule::within | Rule::kw_within => (More, "`within`"),
        Rule::probability | Rule::kw_with => (More, "`with`"),
        Rule::kw_probability => (Word, "`probability`"),
        Rule::test | Rule::kw_test => (Word, "`test`"),
        Rule::title => (Part, "a title in quotes"),
        Rule::kw_of => (Word, "`of`"),
        Rule::given | Rule::kw_given => (Word, "`given`"),
        Rule::test_tick => (Word, "`tick`"),
        Rule::changes | Rule::change => (Part, "a predicate"),
        Rule::lasting => (More, "`for`"),
        Rule::steps | Rule::step => (Part, "a behaviour"),
        Rule::answer => (More, "`succeeds`, `fails`, `runs`"),
        Rule::std => (Word, "`std`"),
        Rule::outcome => (Word, "`success`, `failure`"),
        Rule::open_brace => (Mark, "`{`"),
        Rule::close_brace => (Mark, "`}`"),
        Rule::open_paren => (Mark, "`(`"),
        Rule::close_paren => (Mark, "`)`"),
        Rule::comma => (Mark, "`,`"),
        Rule::colon | Rule::reward_colon | Rule::of_kind | Rule::ascription => (Mark, "`:`"),
        Rule::is | Rule::named_is | Rule::assign => (Mark, "`=`"),
        Rule::guards => (Mark, "`=>`"),
        Rule::at_least => (Mark, "`>=`"),
        Rule::range_to => (More, "`..`"),
        Rule::link => (More, "`of`, `per`, `->`"),
        Rule::string => (Part, "a path in quotes"),
        Rule::pin => (More, "`sha256:` with 64 hexadecimal digits"),
        Rule::name | Rule::learner_name | Rule::family => (Part, "a name"),
        Rule::field | Rule::setting | Rule::named => (Part, "a name"),
        Rule::params | Rule::typed_params => (More, "parameters"),
        Rule::param | Rule::typed_param => (Part, "a parameter"),
        Rule::type_expr => (Part, "a type"),
        Rule::clauses => (Mark, "`{`"),
        Rule::block => (Mark, "`{`"),
        Rule::children | Rule::r#yield => (Mark, "`{`"),
        Rule::args => (More, "arguments in parentheses"),
        Rule::arg | Rule::binder => (Part, "an argument"),
        Rule::list | Rule::list_item => (Part, "a list of values"),
        Rule::node | Rule::composite | Rule::node_word => (Part, "a node"),
        Rule::for_stmt | Rule::branch | Rule::simple_stmt => (Part, "a statement"),
        Rule::start_line => (Part, "a name"),
        Rule::number => (Part, "a number"),
        Rule::unit => (More, "a unit"),
        Rule::quantity => (Part, "a number"),
        Rule::condition
        | Rule::expr
        | Rule::conjunct
        | Rule::negation
        | Rule::comparison
        | Rule::sum
        | Rule::term
        | Rule::unary
        | Rule::power
        | Rule::paren
        | Rule::choice
        | Rule::boolean
        | Rule::not_op
        | Rule::sign => (Part, "a value"),
        Rule::r#ref => (Part, "a name"),
        Rule::or_op
        | Rule::and_op
        | Rule::compare_op
        | Rule::sum_op
        | Rule::term_op
        | Rule::power_op
        | Rule::coordinate => (More, "an operator"),
        Rule::file
        | Rule::EOI
        | Rule::WHITESPACE
        | Rule::COMMENT
        | Rule::item
        | Rule::values
        | Rule::world_entry
        | Rule::robot_entry
        | Rule::clause
        | Rule::aspect
        | Rule::learn_entry
        | Rule::child
        | Rule::stmt
        | Rule::primary
        | Rule::bare_aspect
        | Rule::aspect_word
        | Rule::name_char
        | Rule::reserved
        | Rule::factor
        | Rule::factor_name
        | Rule::wrong_unit
        | Rule::wrong_factor
        | Rule::assign_ahead
        | Rule::type_op
        | Rule::wrong_node_call
        | Rule::wrong_spaced_call
        | Rule::lone_equals
        | Rule::wrong_equals
        | Rule::wrong_paren_equals
        | Rule::wrong_paid_equals
        | Rule::wrong_guard_equals
        | Rule::wrong_is
        | Rule::wrong_comma
        | Rule::wrong_choice
        | Rule::wrong_or
        | Rule::wrong_and
        | Rule::wrong_not
        | Rule::wrong_link
        | Rule::wrong_facing
        | Rule::wrong_control
        | Rule::wrong_memory
        | Rule::wrong_start
        | Rule::wrong_per
        | Rule::wrong_field
        | Rule::wrong_branch
        | Rule::field_name
        | Rule::price_time
        | Rule::paid_unit
        | Rule::list_expr
        | Rule::open
        | Rule::missing_open
        | Rule::entry_ahead
        | Rule::world_ahead
        | Rule::stmt_ahead
        | Rule::call_ahead
        | Rule::child_ahead
        | Rule::known_word
        | Rule::unopened
        | Rule::clause_ahead
        | Rule::start_ahead
        | Rule::reward_ahead
        | Rule::wrong_else_if
        | Rule::wrong_answer
        | Rule::wrong_verb
        | Rule::test_entry
        | Rule::test_ahead
        | Rule::unclosed_string
        | Rule::unclosed_name
        | Rule::stray_mark
        | Rule::stray_close
        | Rule::missing_else
        | Rule::missing_type
        | Rule::missing_comma
        | Rule::missing_child_comma
        | Rule::missing_arg_comma
        | Rule::close
        | Rule::missing_close
        | Rule::bad_item
        | Rule::bad_entry
        | Rule::bad_reward
        | Rule::bad_child
        | Rule::bad_line
        | Rule::next_line
        | Rule::children_end
        | Rule::item_line
        | Rule::entry_line
        | Rule::margin_item
        | Rule::item_ahead
        | Rule::held
        | Rule::junk_group
        | Rule::junk_part
        | Rule::blank
        | Rule::gap
        | Rule::strict_item
        | Rule::strict_world_entry
        | Rule::strict_robot_entry
        | Rule::strict_clause
        | Rule::strict_aspect
        | Rule::strict_start_line
        | Rule::strict_reward
        | Rule::strict_learn_entry
        | Rule::strict_test_entry
        | Rule::strict_child
        | Rule::strict_stmt
        | Rule::strict_choice => return None,
    })
}
