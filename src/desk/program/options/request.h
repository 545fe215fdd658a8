/* The operands and options that a verb was given: the words of the command line, in which it looks
 * for its options. */
#pragma once

#include "celspan/celspan.h"
#include "program/options/verbs.h"
#include "program/report/report.h"

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
