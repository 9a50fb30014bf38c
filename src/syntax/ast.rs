//! The spanned syntax tree, one type a production of the grammar.
//!
//! Every node knows its place. Text that the parser could not make sense of stands as an `Error` node, about
//! which a diagnostic has been reported already: later passes pass over it in silence.

use crate::source::Span;

/// A name as it is used or declared; without its backquotes if it had any.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Ident {
    /// The name.
    pub name: String,
    /// Where it stands, backquotes included.
    pub span: Span,
}

/// A value with its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spanned<T> {
    /// The value.
    pub node: T,
    /// Its place.
    pub span: Span,
}

/// A comment, as the formatter keeps it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// Which of the three kinds it is.
    pub kind: CommentKind,
    /// The text after the slashes, without trailing blanks.
    pub text: String,
    /// From the first slash to the last character.
    pub span: Span,
}

/// The three kinds of comments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommentKind {
    /// `//`
    Plain,
    /// `///`, of the next item.
    Item,
    /// `//!`, of the file.
    File,
}

/// A whole file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct File {
    /// The items, in their order.
    pub items: Vec<Item>,
    /// Every comment of every kind, by position.
    pub comments: Vec<Comment>,
    /// The whole text.
    pub span: Span,
}

/// A top-level item with its documentation.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// The `///` lines before it, without slashes and without the blank after them.
    pub docs: Vec<String>,
    /// What it is.
    pub kind: ItemKind,
    /// Without its documentation.
    pub span: Span,
}

/// The kinds of items.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemKind {
    /// `use std`, `use "other.bt"`
    Use(Use),
    /// `world name { … }`
    World(World),
    /// `enum name { a, b }`
    Enum(Enum),
    /// `state name: type = expr`
    State(State),
    /// `event name = expr`
    Event(Event),
    /// `each tick { … }`
    EachTick(Block),
    /// `on event { … }`
    On(On),
    /// `let name(…): type = expr`
    Let(Let),
    /// `predicate name = expr`
    Predicate(Predicate),
    /// `behavior name(…) { … }`
    Behavior(Behavior),
    /// `task name { … }`
    Task(Task),
    /// `learn name { … }`
    Learn(Learn),
    /// `tree name for task = node`
    Tree(Tree),
    /// `claim a equals b`
    Claim(Claim),
    /// Not understood, and reported.
    Error,
}

/// `use std` or `use "path"`.
#[derive(Clone, Debug, PartialEq)]
pub struct Use {
    /// What is used.
    pub what: Spanned<UseWhat>,
}

/// What a `use` names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UseWhat {
    /// The embedded library.
    Std,
    /// A file, by a path relative to the file that uses it.
    Path(String),
}

/// `world name { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// Its name.
    pub name: Ident,
    /// Places, walls, robots and fields, in their order.
    pub entries: Vec<WorldEntry>,
}

/// An entry of a world.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldEntry {
    /// The `///` lines before it.
    pub docs: Vec<String>,
    /// What it is.
    pub kind: WorldEntryKind,
    /// Without its documentation.
    pub span: Span,
}

/// The kinds of world entries.
#[derive(Clone, Debug, PartialEq)]
pub enum WorldEntryKind {
    /// `place name: kind = shape facing angle`
    Place {
        /// Its name.
        name: Ident,
        /// The kind that families range over.
        of_kind: Option<Ident>,
        /// The shape.
        shape: Expr,
        /// The direction in which a robot stands here.
        facing: Option<Expr>,
    },
    /// `wall name: kind = shape when condition`
    Wall {
        /// Its name.
        name: Ident,
        /// The kind that families range over.
        of_kind: Option<Ident>,
        /// The shape.
        shape: Expr,
        /// The condition under which it stands.
        when: Option<Expr>,
    },
    /// `robot name { … }`
    Robot {
        /// Its name.
        name: Ident,
        /// Sensors and fields.
        entries: Vec<RobotEntry>,
    },
    /// `tick = …`, `arena = …`
    Field(Field),
    /// Not understood, and reported.
    Error,
}

/// An entry of a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotEntry {
    /// The `///` lines before it.
    pub docs: Vec<String>,
    /// What it is.
    pub kind: RobotEntryKind,
    /// Without its documentation.
    pub span: Span,
}

/// The kinds of robot entries.
#[derive(Clone, Debug, PartialEq)]
pub enum RobotEntryKind {
    /// `sensor name = scanner(…)`
    Sensor {
        /// Its name.
        name: Ident,
        /// What it is.
        value: Expr,
    },
    /// `body = …`, `drive = …`, `contact = …`, `runs = …`
    Field(Field),
    /// Not understood, and reported.
    Error,
}

/// `name = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: Ident,
    /// Its value.
    pub value: Expr,
}

/// `enum name { a, b }`
#[derive(Clone, Debug, PartialEq)]
pub struct Enum {
    /// Its name.
    pub name: Ident,
    /// Its variants.
    pub variants: Vec<Ident>,
}

/// `state name(params): type = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Its name.
    pub name: Ident,
    /// The parameters of a family.
    pub params: Option<Params>,
    /// Its type; that of the value if not given.
    pub ty: Option<TypeExpr>,
    /// The value at the start of an episode.
    pub value: Expr,
}

/// `event name(params) = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Its name.
    pub name: Ident,
    /// The parameters of a family.
    pub params: Option<Params>,
    /// When it happens.
    pub value: Expr,
}

/// `on event { … }`; in `on picked(b: bush) { … }` the parameters bind.
#[derive(Clone, Debug, PartialEq)]
pub struct On {
    /// What it waits for.
    pub trigger: Trigger,
    /// Its effects.
    pub block: Block,
}

/// What an `on` waits for.
#[derive(Clone, Debug, PartialEq)]
pub enum Trigger {
    /// An event or any expression of events.
    Expr(Expr),
    /// Every event of a family; the parameters, with their types, bind.
    Family {
        /// The family.
        name: Ident,
        /// What binds.
        params: Params,
    },
}

/// `let name(params): type = body`
#[derive(Clone, Debug, PartialEq)]
pub struct Let {
    /// Its name.
    pub name: Ident,
    /// Its parameters.
    pub params: Option<Params>,
    /// The type of its value.
    pub ty: Option<TypeExpr>,
    /// Its value.
    pub body: LetBody,
}

/// The value of a `let`.
#[derive(Clone, Debug, PartialEq)]
pub enum LetBody {
    /// `= expr`
    Expr(Expr),
    /// `= { let … expr }`
    Yield(Yield),
}

/// `predicate name(params) = expr`; without a value it is declared only.
#[derive(Clone, Debug, PartialEq)]
pub struct Predicate {
    /// Its name.
    pub name: Ident,
    /// The parameters of a family.
    pub params: Option<Params>,
    /// When it holds.
    pub value: Option<Expr>,
}

/// `behavior name(params) { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Behavior {
    /// Its name.
    pub name: Ident,
    /// Its parameters.
    pub params: Option<Params>,
    /// What it does.
    pub body: BehaviorBody,
}

/// What a behaviour does.
#[derive(Clone, Debug, PartialEq)]
pub enum BehaviorBody {
    /// Declared only, for trees of foreign tables.
    Declared,
    /// `= goto(A)`
    Alias(Ref),
    /// `{ … }`
    Clauses(Vec<Clause>),
}

/// A clause of a behaviour.
#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    /// What it is.
    pub kind: ClauseKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of clauses.
#[derive(Clone, Debug, PartialEq)]
pub enum ClauseKind {
    /// `local name: type = expr`
    Local {
        /// Its name.
        name: Ident,
        /// Its type.
        ty: Option<TypeExpr>,
        /// Its value when the behaviour starts.
        value: Expr,
    },
    /// `requires expr`
    Requires(Expr),
    /// `succeed when expr`
    Succeed(Expr),
    /// `fail when expr`
    Fail(Expr),
    /// `control { … }`
    Control(Block),
    /// Not understood, and reported.
    Error,
}

/// `task name { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// Its name.
    pub name: Ident,
    /// Its aspects, in their order.
    pub aspects: Vec<Aspect>,
}

/// An aspect of a task.
#[derive(Clone, Debug, PartialEq)]
pub struct Aspect {
    /// What it is.
    pub kind: AspectKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of aspects.
#[derive(Clone, Debug, PartialEq)]
pub enum AspectKind {
    /// `observe a, b`
    Observe(Vec<Expr>),
    /// `choose a, b`
    Choose(Vec<Expr>),
    /// `history last 1 success, failure`
    History {
        /// How many terminations the window holds.
        window: Expr,
        /// Which terminations enter it.
        outcomes: Vec<Spanned<Outcome>>,
    },
    /// `patience 600 ticks`
    Patience(Expr),
    /// `start { … }`
    Start(Start),
    /// `end on event`
    EndOn(Expr),
    /// `end after 5_000 ticks`
    EndAfter(Expr),
    /// `reward { … }`
    Reward {
        /// `on event: value`
        lines: Vec<RewardLine>,
        /// `otherwise: value`
        otherwise: Option<Expr>,
    },
    /// Not understood, and reported.
    Error,
}

/// How a behaviour ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// With success.
    Success,
    /// With failure.
    Failure,
}

/// `start { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Its lines, in the order in which they run.
    pub lines: Vec<StartLine>,
    /// From the word to the brace.
    pub span: Span,
}

/// `target = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct StartLine {
    /// What is set.
    pub target: Ref,
    /// Its value.
    pub value: Expr,
    /// The line.
    pub span: Span,
}

/// `on event: value`
#[derive(Clone, Debug, PartialEq)]
pub struct RewardLine {
    /// The event.
    pub event: Expr,
    /// Its reward.
    pub value: Expr,
    /// The line.
    pub span: Span,
}

/// `learn name for task { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Learn {
    /// The learner's name, `learned` if not given.
    pub name: Option<Ident>,
    /// The task.
    pub task: Ident,
    /// Its settings.
    pub entries: Vec<LearnEntry>,
}

/// An entry of a learner.
#[allow(clippy::large_enum_variant, reason = "a learner has a dozen of them")]
#[derive(Clone, Debug, PartialEq)]
pub enum LearnEntry {
    /// `start { … }`
    Start(Start),
    /// `name = expr [of | per | -> expr]`
    Setting(Setting),
    /// Not understood, and reported.
    Error(Span),
}

/// `name = expr`, with what may follow it.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Its name.
    pub name: Ident,
    /// Its value.
    pub value: Expr,
    /// `of`, `per` or `->` and what follows.
    pub tail: Option<(Spanned<Link>, Expr)>,
    /// The line.
    pub span: Span,
}

/// What joins the two values of a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// `16_700 of 300 ticks`
    Of,
    /// `0.95 per decision`
    Per,
    /// `35% -> 5%`
    Arrow,
}

/// `tree name(params) for task = node`
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Its name.
    pub name: Ident,
    /// The parameters of a subtree.
    pub params: Option<Params>,
    /// The task that it is for.
    pub task: Option<Ident>,
    /// The tree.
    pub root: Node,
}

/// A node of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// What it is.
    pub kind: NodeKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of nodes.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeKind {
    /// `memory sequence { … }`, `retry(3) { … }`
    Composite {
        /// The place of `memory`, if it is there.
        memory: Option<Span>,
        /// Which composite or decorator it is.
        word: Spanned<Word>,
        /// Its arguments.
        args: Option<Vec<Arg>>,
        /// Its children.
        children: Vec<Node>,
    },
    /// `guard => node`
    Guarded {
        /// The guard.
        guard: Expr,
        /// What it guards.
        node: Box<Node>,
    },
    /// A condition, a behaviour or a subtree.
    Leaf(Expr),
    /// Not understood, and reported.
    Error,
}

/// The words of composites and decorators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Word {
    /// Tries its children until one does not fail.
    Selector,
    /// Tries its children until one does not succeed.
    Sequence,
    /// Ticks all its children.
    Parallel,
    /// Exchanges success and failure.
    Invert,
    /// Turns failure into success.
    Succeed,
    /// Turns success into failure.
    Fail,
    /// Tries again after a failure.
    Retry,
    /// Starts again after a success.
    Repeat,
    /// Fails after a time.
    Timeout,
}

/// `claim tree equals tree`, `claim tree never event …`
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// The tree that it is about.
    pub tree: Ident,
    /// What is claimed.
    pub what: ClaimWhat,
    /// `within t`
    pub within: Option<Expr>,
    /// `with probability >= p`; true if strict.
    pub probability: Option<(bool, Expr)>,
}

/// What is claimed.
#[derive(Clone, Debug, PartialEq)]
pub enum ClaimWhat {
    /// `equals other`
    Equals(Ident),
    /// `never event`
    Never(Expr),
    /// `reaches event`
    Reaches(Expr),
}

/// `{ … }` with statements.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// The statements.
    pub stmts: Vec<Stmt>,
    /// From brace to brace.
    pub span: Span,
}

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Stmt {
    /// What it is.
    pub kind: StmtKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of statements.
#[derive(Clone, Debug, PartialEq)]
pub enum StmtKind {
    /// `let name: type = expr`
    Let(Binding),
    /// `for b in bush { … }`
    For {
        /// What binds.
        name: Ident,
        /// What it ranges over.
        domain: Ident,
        /// What is done for each.
        block: Block,
    },
    /// `if … { … } else …`
    Branch(Branch),
    /// `target = expr`, `target += expr`
    Assign {
        /// What is set.
        target: Ref,
        /// How.
        op: Spanned<AssignOp>,
        /// The value.
        value: Expr,
    },
    /// `drive(…)`
    Call(Ref),
    /// Not understood, and reported.
    Error,
}

/// `let name: type = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// What binds.
    pub name: Ident,
    /// Its type.
    pub ty: Option<TypeExpr>,
    /// Its value.
    pub value: Expr,
    /// The line.
    pub span: Span,
}

/// `if cond { … } else …`
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// The condition.
    pub cond: Expr,
    /// What is done if it holds.
    pub then: Block,
    /// What is done else.
    pub otherwise: Option<Box<Else>>,
}

/// What follows `else`.
#[derive(Clone, Debug, PartialEq)]
pub enum Else {
    /// `else if …`
    If(Branch),
    /// `else { … }`
    Block(Block),
}

/// `=`, `+=` and the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssignOp {
    /// `=`
    Set,
    /// `+=`
    Add,
    /// `-=`
    Sub,
    /// `*=`
    Mul,
    /// `/=`
    Div,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// `5_000 ticks`
    Number(Literal),
    /// `true`, `false`
    Bool(bool),
    /// A name, or a call.
    Ref(Ref),
    /// `if c { a } else { b }`
    If(Box<Choice>),
    /// `(x, y)`
    Point(Box<Expr>, Box<Expr>),
    /// `(e)`
    Paren(Box<Expr>),
    /// `-e`, `not e`
    Unary {
        /// The operator.
        op: Spanned<UnaryOp>,
        /// The operand.
        operand: Box<Expr>,
    },
    /// `a + b`
    Binary {
        /// The operator.
        op: Spanned<BinaryOp>,
        /// The left operand.
        left: Box<Expr>,
        /// The right operand.
        right: Box<Expr>,
    },
    /// Not understood, and reported.
    Error,
}

/// A number with its unit, in its own spelling.
#[derive(Clone, Debug, PartialEq)]
pub struct Literal {
    /// The digits as they are written, such as `5_000` or `1e-3`.
    pub digits: String,
    /// What they say.
    pub value: f64,
    /// The unit.
    pub unit: Option<Unit>,
}

/// A unit, such as `m/s` or `rad/m`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// As it is written.
    pub text: String,
    /// Its factors.
    pub factors: Vec<UnitFactor>,
    /// Where it stands.
    pub span: Span,
}

/// A factor of a unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFactor {
    /// Its name, from the closed list of the grammar.
    pub name: String,
    /// Its exponent, negative after a `/`.
    pub power: i32,
}

/// A name with arguments.
#[derive(Clone, Debug, PartialEq)]
pub struct Ref {
    /// The name.
    pub name: Ident,
    /// The arguments; `None` where there are no parentheses.
    pub args: Option<Vec<Arg>>,
    /// From the name to the closing parenthesis.
    pub span: Span,
}

/// An argument.
#[derive(Clone, Debug, PartialEq)]
pub struct Arg {
    /// What it is.
    pub kind: ArgKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of arguments.
#[derive(Clone, Debug, PartialEq)]
pub enum ArgKind {
    /// `expr`
    Positional(Expr),
    /// `name = expr`
    Named(Ident, Expr),
    /// `b in bush: expr`
    Binder {
        /// What binds.
        name: Ident,
        /// What it ranges over.
        domain: Ident,
        /// What is said of each.
        body: Option<Expr>,
    },
}

/// `if c { a } else { b }` as an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The condition.
    pub cond: Expr,
    /// The value if it holds.
    pub then: Yield,
    /// The value else.
    pub otherwise: Otherwise,
}

/// What follows the `else` of a choice.
#[derive(Clone, Debug, PartialEq)]
pub enum Otherwise {
    /// `else if …`
    If(Box<Choice>, Span),
    /// `else { … }`
    Yield(Yield),
}

/// `{ let … expr }`
#[derive(Clone, Debug, PartialEq)]
pub struct Yield {
    /// What is bound first.
    pub bindings: Vec<Binding>,
    /// The value.
    pub value: Box<Expr>,
    /// From brace to brace.
    pub span: Span,
}

/// `-`, `+`, `not`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryOp {
    /// `-`
    Neg,
    /// `+`
    Pos,
    /// `not`
    Not,
}

/// The binary operators, loosest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BinaryOp {
    /// `or`
    Or,
    /// `and`
    And,
    /// `==`
    Eq,
    /// `!=`
    Ne,
    /// `<`
    Lt,
    /// `<=`
    Le,
    /// `>`
    Gt,
    /// `>=`
    Ge,
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`
    Mul,
    /// `/`
    Div,
    /// `^`
    Pow,
}

/// `(name: type = default, …)`
#[derive(Clone, Debug, PartialEq)]
pub struct Params {
    /// The parameters.
    pub params: Vec<Param>,
    /// From parenthesis to parenthesis.
    pub span: Span,
}

/// `name: type = default`
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Its name.
    pub name: Ident,
    /// Its type.
    pub ty: TypeExpr,
    /// Its value if no argument is given.
    pub default: Option<Expr>,
    /// Where it stands.
    pub span: Span,
}

/// `length/time`
#[derive(Clone, Debug, PartialEq)]
pub struct TypeExpr {
    /// The names, each with whether it divides.
    pub factors: Vec<(Ident, bool)>,
    /// Where it stands.
    pub span: Span,
}
