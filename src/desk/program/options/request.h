/* The operands and options that a verb takes, and those that it was given.
 *
 *   cs_verb: operands, options, help --> parsing, the help, the manual page, suggestions for names
 *   cs_request: the words of the command line, in which a verb looks for its options
 */
#pragma once

#include "celspan/celspan.h"
#include "program/options/argument.h"
#include "program/report/report.h"

#define CS_OPERANDS_MAX 1024

typedef struct cs_option {
  const char *name;
  const char *value;       /* how the help calls the value; NULL: a flag */
  const cs_argument *kind; /* the kind of the value; NULL: a flag */
  const char *help;
} cs_option;

typedef struct cs_verb {
  const char *name;
  const char *operands; /* as the help shows them */
  size_t operand_least, operand_most;
  bool is_hidden;      /* the help does not list it */
  bool has_script;     /* the verb runs a script, which gets what follows "--" */
  bool makes_folder;   /* -o names a folder */
  bool asks_files;     /* the verb asks which files its script has read */
  bool asks_warnings;  /* the verb asks for warnings about probable mistakes */
  bool runs_again;     /* other processes run its script, too, or it is run again after changes */
  bool runs_others;    /* it runs chunks in Lua that are neither scripts nor celspan's own */
  bool plans_rows;     /* it plans runs of another verb, which make the rows and write the log */
  const char *summary; /* one line */
  const char *notes;   /* more help, whole lines, or NULL */
  const cs_option *options; /* the last one has no name */
} cs_verb;

/* All texts are borrowed: from the command line; the script's text from the caller that runs the
 * verb. */
typedef struct cs_request {
  const cs_verb *verb;
  char *const *words; /* the words after the verb */
  size_t word_count;
  const char *operands[CS_OPERANDS_MAX];
  size_t operand_count;
  const char *script; /* the text of the script, if the operand is -; NULL: the script is a file */
  size_t script_size;
  char *const *script_arguments; /* the arguments after "--" */
  size_t script_argument_count;
  const struct cs_spaces *spaces; /* NULL: colours are coded along a curve */
  const struct cs_output *output; /* the row of -o (output.h); NULL: there is none, or not known */
  cs_given_antialias antialias;   /* from --antialias; kept here because frames point to it */
} cs_request;

/* words: the words after the verb. OK, or reported and CS_EXIT_USAGE. */
cs_exit cs_request_parse(const cs_verb *verb, size_t count, char *const *words, cs_request *out);

/* Whether an option was given. */
bool cs_request_has(const cs_request *request, const char *name);
/* Reads an option into the field for its kind. false: the option was not given, or the verb does
 * not have it; then the field does not change. */
bool cs_request_read(const cs_request *request, const char *name, void *field);
/* The text of an option that is one; NULL: it was not given. */
const char *cs_request_text(const cs_request *request, const char *name);
/* The strip of --strip I/N; for a farm's --strips N, the last strip. Without either, returns false
 * and sets 0 0. */
bool cs_request_strip(const cs_request *request, int32_t strip[2]);
/* Calls `call` for each option that was given, in their order. value: NULL for a flag. */
void cs_request_each(const cs_request *request,
                     void (*call)(void *user, const char *name, const char *value), void *user);
/* Reports "--at: '1,2' is not ..." for an option that was given. */
cs_exit cs_request_refuse(const cs_request *request, const char *name);
