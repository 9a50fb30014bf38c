// A unit stands on the line of its number: `5 m`, `0.4 m/s`, `30%`. A name that is given a value is none: `n = 5` and then
// `m = 3`.
#include "tree_sitter/parser.h"

#include <string.h>

enum { UNIT };

void *tree_sitter_behaviortree_external_scanner_create(void) { return NULL; }
void tree_sitter_behaviortree_external_scanner_destroy(void *payload) { (void)payload; }
unsigned tree_sitter_behaviortree_external_scanner_serialize(void *payload, char *buffer) {
  (void)payload;
  (void)buffer;
  return 0;
}
void tree_sitter_behaviortree_external_scanner_deserialize(void *payload, const char *buffer, unsigned length) {
  (void)payload;
  (void)buffer;
  (void)length;
}

static bool is_digit(int32_t c) { return c >= '0' && c <= '9'; }

static bool is_name(int32_t c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
}

static const char *const NAMES[] = {"ms", "mm", "min", "m", "cm", "km", "s", "h", "ticks", "tick", "deg", "rad", "Hz"};

// `%`, `m`, `s^2`
static bool factor(TSLexer *lexer) {
  if (lexer->lookahead == '%') {
    lexer->advance(lexer, false);
  } else {
    char name[8] = {0};
    unsigned length = 0;
    for (; is_name(lexer->lookahead); length++) {
      if (length + 1 >= sizeof name) return false;
      name[length] = (char)lexer->lookahead;
      lexer->advance(lexer, false);
    }
    bool known = false;
    for (unsigned i = 0; i < sizeof NAMES / sizeof *NAMES; i++) known |= strcmp(name, NAMES[i]) == 0;
    if (!known) return false;
  }
  lexer->mark_end(lexer);
  if (lexer->lookahead == '^') {
    lexer->advance(lexer, false);
    if (!is_digit(lexer->lookahead)) return true;
    while (is_digit(lexer->lookahead)) lexer->advance(lexer, false);
    lexer->mark_end(lexer);
  }
  return true;
}

// `=`, `+=`, but neither `==` nor `=>`
static bool is_assigned(TSLexer *lexer) {
  while (lexer->lookahead == ' ' || lexer->lookahead == '\t' || lexer->lookahead == '\r' || lexer->lookahead == '\n') {
    lexer->advance(lexer, false);
  }
  if (lexer->lookahead == '+' || lexer->lookahead == '-' || lexer->lookahead == '*' || lexer->lookahead == '/') {
    lexer->advance(lexer, false);
  }
  if (lexer->lookahead != '=') return false;
  lexer->advance(lexer, false);
  return lexer->lookahead != '=' && lexer->lookahead != '>';
}

bool tree_sitter_behaviortree_external_scanner_scan(void *payload, TSLexer *lexer, const bool *valid_symbols) {
  (void)payload;
  if (!valid_symbols[UNIT]) return false;
  while (lexer->lookahead == ' ' || lexer->lookahead == '\t') lexer->advance(lexer, true);
  if (!factor(lexer)) return false;
  while (lexer->lookahead == '/') {
    lexer->advance(lexer, false);
    if (!factor(lexer)) break;
  }
  lexer->result_symbol = UNIT;
  return !is_assigned(lexer);
}
