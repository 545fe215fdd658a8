#include "trace/solve.h"

#include <math.h>

static void swap_rows(double *a, double *b, int count) {
  for (int i = 0; i < count; i++) {
    double kept = a[i];
    a[i] = b[i];
    b[i] = kept;
  }
}

bool cs_solve(double *m, int n, double least) {
  int width = n + 1;
  for (int k = 0; k < n; k++) {
    int best = k;
    for (int i = k + 1; i < n; i++)
      best = fabs(m[i * width + k]) > fabs(m[best * width + k]) ? i : best;
    if (fabs(m[best * width + k]) < least)
      return false;
    swap_rows(m + k * width, m + best * width, width);
    for (int i = 0; i < n; i++) {
      double factor = i == k ? 0 : m[i * width + k] / m[k * width + k];
      for (int j = k; j <= n; j++)
        m[i * width + j] -= factor * m[k * width + j];
    }
  }
  for (int k = 0; k < n; k++)
    m[k * width + n] /= m[k * width + k];
  return true;
}
