/* Decimal numbers in texts, as SVG and CSS write them: "-12.5e3", ".5", "+7".
 *
 * Invariant: a text is the same number everywhere, because no locale and no library takes part: the
 * first nineteen digits with a single rounding as long as the power of ten is exact.
 */
#pragma once

/* The number that text begins with; infinite when it is too large. Returns the text after it, or
 * NULL when text does not begin with a number. An e without digits after it is not part of the
 * number. */
const char *cs_decimal_read(const char *text, double *out);
