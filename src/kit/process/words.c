#include "process/words.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>

void cs_words_add(cs_words *words, const char *bytes, size_t size) {
  size_t kept = words->size;
  if (kept > CS_WORDS - size)
    kept = CS_WORDS - size;
  memmove(words->text, words->text + words->size - kept, kept);
  memcpy(words->text + kept, bytes, size);
  words->size = kept + size;
}

void cs_words_join(cs_words *words) {
  char *text = words->text;
  size_t size = 0;
  for (size_t i = 0; i < words->size; i++) {
    unsigned char c = (unsigned char)text[i];
    bool is_blank = c <= ' ' || c == 127;
    if (!is_blank)
      text[size++] = (char)c;
    else if (size > 0 && text[size - 1] != ' ')
      text[size++] = ' ';
  }
  words->size = size > 0 && text[size - 1] == ' ' ? size - 1 : size;
  text[words->size] = '\0';
}

void cs_words_describe(const cs_words *words, int ending, char *out, size_t size) {
  const char *colon = words->size > 0 ? ": " : "";
  if (WIFEXITED(ending))
    snprintf(out, size, "ended with exit code %d%s%s", WEXITSTATUS(ending), colon, words->text);
  else
    snprintf(out, size, "was ended by signal %d%s%s", WTERMSIG(ending), colon, words->text);
}
