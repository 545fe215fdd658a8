#include "common/solve.h"

#include <math.h>

static void swap_rows(double *a, double *b, int count) {
  for (int i = 0; i < count; i++) {
    double kept = a[i];
    a[i] = b[i];
    b[i] = kept;
  }
}

static int find_pivot(const double *rows, int n, int stride, int column) {
  int best = column;
  for (int i = column + 1; i < n; i++)
    if (fabs(rows[i * stride + column]) > fabs(rows[best * stride + column]))
      best = i;
  return best;
}

static void eliminate(double *rows, int n, int stride, int column) {
  const double *pivot = rows + column * stride;
  for (int i = column + 1; i < n; i++) {
    double *row = rows + i * stride, factor = row[column] / pivot[column];
    for (int j = column; j <= n; j++)
      row[j] -= factor * pivot[j];
  }
}

bool cs_solve(double *rows, int n, int stride, double least, double *out) {
  for (int k = 0; k < n; k++) {
    int pivot = find_pivot(rows, n, stride, k);
    if (!(fabs(rows[pivot * stride + k]) > least))
      return false;
    swap_rows(rows + k * stride, rows + pivot * stride, n + 1);
    eliminate(rows, n, stride, k);
  }
  for (int k = n; k-- > 0;) {
    const double *row = rows + k * stride;
    double sum = row[n];
    for (int j = k + 1; j < n; j++)
      sum -= row[j] * out[j];
    out[k] = sum / row[k];
  }
  return true;
}
