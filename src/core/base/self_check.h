/* Self-checks: the promises of headers, checked while the program runs.
 *
 * The meson option `checks` builds them in; builds that are tested have it. A build that is
 * installed or measured does not: there a claim is not even evaluated, and the functions that
 * decide claims, in files named *_check.c, are not compiled.
 *
 * A claim that is false is a fault of the core, never of data that came from outside: it ends the
 * process at once, as `assert` does, so that a debugger or a sanitizer shows who broke it.
 */
#pragma once

#ifdef CELSPAN_CHECKS

/* Prints the claim and its place in the source, and ends the process. */
_Noreturn void cs_self_check_failed(const char *claim, const char *file, int line);

#define CS_SELF_CHECK(claim) ((claim) ? (void)0 : cs_self_check_failed(#claim, __FILE__, __LINE__))

#else

#define CS_SELF_CHECK(claim) ((void)0)

#endif
