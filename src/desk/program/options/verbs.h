/* The verbs: their operands and options, and their help. Each is a file of its name in verbs/, in
 * Lua.
 *
 *   cs_verb: operands, options, help --> parsing, the help, the manual page, suggestions for names
 */
#pragma once

#include "program/options/argument.h"

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
  bool is_hidden;       /* the help does not list it */
  bool has_script;      /* the verb runs a script, which gets what follows "--" */
  bool makes_folder;    /* -o names a folder */
  bool asks_files;      /* the verb asks which files its script has read */
  bool asks_warnings;   /* the verb asks for warnings about probable mistakes */
  bool runs_again;      /* other processes run its script, too, or it is run again after changes */
  bool runs_others;     /* it runs chunks in Lua that are neither scripts nor celspan's own */
  bool plans_rows;      /* it plans runs of another verb, which make the rows and write the log */
  const char *summary;  /* one line */
  const char *notes;    /* more help, whole lines, or NULL */
  const char *options;  /* the names of its options in the order of the help, a space after each */
  const cs_option *own; /* rows of options that other verbs lack, or describe in other words, ended
                         * by a row without a name; NULL: none */
} cs_verb;

/* The option whose name is at *at, in the list of the verb; moves *at to the next name, or to the
 * end. */
const cs_option *cs_verb_option(const cs_verb *verb, const char **at);

/* In the order of the help; the last one has no name. */
extern const cs_verb cs_verbs[];
/* NULL: there is none. */
const cs_verb *cs_verb_named(const char *name);
