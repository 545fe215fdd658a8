/* The last words of a program: the end of its output on standard error, for a message. */
#pragma once

#include <stddef.h>

enum { CS_WORDS = 512 };

typedef struct cs_words {
  char text[CS_WORDS + 1]; /* terminated by cs_words_join */
  size_t size;
} cs_words;

/* size: at most CS_WORDS. */
void cs_words_add(cs_words *words, const char *bytes, size_t size);
/* Joins all lines into one: unprintable bytes become blanks, and blanks at the ends are removed. */
void cs_words_join(cs_words *words);
/* Writes "ended with exit code 1: the words". ending: the status of waitpid. */
void cs_words_describe(const cs_words *words, int ending, char *out, size_t size);
