#include "program/options/request.h"

#include <ctype.h>
#include <string.h>

#include "lua/bind/suggest.h"

enum { NAME_SIZE = 32, NAMES_MOST = 64 };

/* ---------------------------------------------------------------- options */

static bool has_option(const cs_verb *verb, const char *name) {
  if (strchr(name, ' '))
    return false;
  const size_t size = strlen(name);
  for (const char *at = verb->options; (at = strstr(at, name)); at += size)
    if ((at == verb->options || at[-1] == ' ') && at[size] == ' ')
      return true;
  return false;
}

/* value: after "=", or NULL. */
static cs_exit refuse_unknown(const cs_verb *verb, const char *name, const char *value) {
  const char *names[NAMES_MOST];
  size_t count = 0;
  for (const char *at = verb->options; *at && count < NAMES_MOST;)
    names[count++] = cs_verb_option(verb, &at)->name;
  const char *nearest = cs_suggest_name(name, names, count);
  if (nearest)
    return cs_report_usage("unknown option '%s': did you mean '%s'?", name, nearest);
  if (value && has_option(verb, "--set"))
    return cs_report_usage("unknown option '%s': a parameter of the script is given by --set %s=%s",
                           name, name + 2, value);
  return cs_report_usage("unknown option '%s' ('celspan help %s' lists the options)", name,
                         verb->name);
}

/* ---------------------------------------------------------------- words */

/* The words of a request, one option or operand at a time. */
typedef struct reading {
  const cs_request *request;
  bool is_new;             /* the words have not been parsed before: an option may be unknown */
  size_t next;             /* word */
  const cs_option *option; /* the option that was read last; NULL: an operand */
  const char *text;        /* the value of the option, NULL for a flag; or the operand */
} reading;

/* "-" alone is a file, and "-3" a number; neither is an option. */
static bool is_option(const char *text) {
  return text[0] == '-' && text[1] && !isdigit((unsigned char)text[1]) && text[1] != '.';
}

/* Reads --name value, --name=value, or a flag. */
static cs_exit read_option(reading *r) {
  const cs_request *request = r->request;
  const char *word = request->words[r->next++];
  char name[NAME_SIZE];
  size_t length = word[1] == '-' ? strcspn(word, "=") : strlen(word);
  if (length >= sizeof name)
    return refuse_unknown(request->verb, word, NULL);
  memcpy(name, word, length);
  name[length] = '\0';
  const char *at = name;
  bool is_known = !r->is_new || has_option(request->verb, name);
  r->option = is_known ? cs_verb_option(request->verb, &at) : NULL;
  r->text = word[length] ? word + length + 1 : NULL;
  if (!r->option)
    return refuse_unknown(request->verb, name, r->text);
  if (!r->option->kind)
    return r->text ? cs_report_usage("%s takes no value", name) : CS_EXIT_OK;
  if (!r->text && r->next == request->word_count)
    return cs_report_usage("%s needs a value: %s", name, r->option->kind->allowed);
  if (!r->text)
    r->text = request->words[r->next++];
  return CS_EXIT_OK;
}

static bool is_read(const reading *r) {
  return r->next == r->request->word_count || strcmp(r->request->words[r->next], "--") == 0;
}

/* OK, or reported. */
static cs_exit read_word(reading *r) {
  if (is_option(r->request->words[r->next]))
    return read_option(r);
  r->option = NULL;
  r->text = r->request->words[r->next++];
  return CS_EXIT_OK;
}

/* The next option of words that were parsed; false: there is none. */
static bool next_option(reading *r) {
  while (!is_read(r) && read_word(r) == CS_EXIT_OK)
    if (r->option)
      return true;
  return false;
}

/* ---------------------------------------------------------------- parsing */

static cs_exit refuse_value(const reading *r) {
  return cs_report_usage("%s: '%s' is not %s", r->option->name, r->text, r->option->kind->allowed);
}

/* The variable into which a kind of value is read. */
typedef union value {
  cs_given_limits limits;
  cs_given_antialias antialias;
  const char *text;
  int32_t integers[4];
  double number;
  float colour[3];
} value;

/* Values are read here so that wrong ones are refused; a verb reads them again into its own
 * fields. */
static cs_exit take_option(const reading *r, cs_given_texts *texts) {
  const cs_argument *kind = r->option->kind;
  value one = {.limits = {.has = {false}}};
  void *field = kind == &cs_argument_texts ? (void *)texts : (void *)&one;
  return !kind || cs_argument_read(kind, r->text, field) ? CS_EXIT_OK : refuse_value(r);
}

static cs_exit take_operand(const char *operand, cs_request *out) {
  bool is_over = out->operand_count == out->verb->operand_most;
  if (is_over && has_option(out->verb, "-o"))
    return cs_report_usage("unexpected argument '%s': write '-o %s' if that is the output; usage: "
                           "celspan %s %s [options]",
                           operand, operand, out->verb->name, out->verb->operands);
  if (is_over)
    return cs_report_usage("unexpected argument '%s'; usage: celspan %s %s [options]", operand,
                           out->verb->name, out->verb->operands);
  out->operands[out->operand_count++] = operand;
  return CS_EXIT_OK;
}

/* Takes the arguments after "--". */
static cs_exit take_script_arguments(const reading *r, cs_request *out) {
  size_t first = r->next + 1;
  if (first > out->word_count)
    return CS_EXIT_OK;
  if (!out->verb->has_script)
    return cs_report_usage("'--' passes arguments to a script, but '%s' does not run one",
                           out->verb->name);
  out->script_arguments = out->words + first;
  out->script_argument_count = out->word_count - first;
  return CS_EXIT_OK;
}

cs_exit cs_request_parse(const cs_verb *verb, size_t count, char *const *words, cs_request *out) {
  cs_given_texts texts = {.count = 0}; /* so that too many texts are refused */
  *out = (cs_request){.verb = verb, .words = words, .word_count = count};
  reading r = {.request = out, .is_new = true};
  cs_exit outcome = CS_EXIT_OK;
  while (!is_read(&r) && outcome == CS_EXIT_OK) {
    outcome = read_word(&r);
    if (outcome == CS_EXIT_OK)
      outcome = r.option ? take_option(&r, &texts) : take_operand(r.text, out);
  }
  if (outcome == CS_EXIT_OK)
    outcome = take_script_arguments(&r, out);
  if (outcome == CS_EXIT_OK)
    cs_request_read(out, "--antialias", &out->antialias);
  if (outcome == CS_EXIT_OK && out->operand_count < verb->operand_least)
    return cs_report_usage("usage: celspan %s %s [options] ('celspan help %s' describes them)",
                           verb->name, verb->operands, verb->name);
  return outcome;
}

/* ---------------------------------------------------------------- asking */

void cs_request_each(const cs_request *request,
                     void (*call)(void *user, const char *name, const char *value), void *user) {
  for (reading r = {.request = request}; next_option(&r);)
    call(user, r.option->name, r.text);
}

/* Finds the last option of this name, which is the one that counts. */
static bool find_given(const cs_request *request, const char *name, reading *out) {
  bool is_given = false;
  for (reading r = {.request = request}; next_option(&r);)
    if (strcmp(r.option->name, name) == 0) {
      is_given = true;
      *out = r;
    }
  return is_given;
}

bool cs_request_has(const cs_request *request, const char *name) {
  reading r;
  return find_given(request, name, &r);
}

const char *cs_request_text(const cs_request *request, const char *name) {
  reading r;
  return find_given(request, name, &r) ? r.text : NULL;
}

/* Options are read in the given order, because some add to earlier ones. */
bool cs_request_read(const cs_request *request, const char *name, void *field) {
  bool is_given = false;
  for (reading r = {.request = request}; next_option(&r);)
    if (strcmp(r.option->name, name) == 0)
      is_given = cs_argument_read(r.option->kind, r.text, field);
  return is_given;
}

bool cs_request_strip(const cs_request *request, int32_t strip[2]) {
  int32_t count = 0;
  bool has_count = cs_request_read(request, "--strips", &count);
  strip[0] = strip[1] = count;
  return has_count || cs_request_read(request, "--strip", strip);
}

cs_exit cs_request_refuse(const cs_request *request, const char *name) {
  reading r;
  return find_given(request, name, &r) ? refuse_value(&r) : CS_EXIT_USAGE;
}
