/* The encoder's choice of a slope: changes propose some, and the one is taken that fits the most of
 * them. Where the chain crosses below another one its changes have no slope.
 */
#include "coder.h"
#include "slope.h"

enum { PROPOSALS = 8, TRIALS = 24, LEAST = 24 /* bits that must be saved */ };

/* number: between two channels. */
static int bits_of(int64_t number) {
  return (int)pf_class_of((uint32_t)(number < 0 ? -number : number));
}

static bool is_known(const pf_beside *change) {
  return change->before[0] && change->before[1] && change->after[0] && change->after[1];
}

static int64_t way(const pf_beside *change, int side, int channel) {
  return (int64_t)change->after[side]->colour[channel] - change->before[side]->colour[channel];
}

/* What a change proposes, by the channel that changes most; 0: nothing. */
static int32_t propose(const pf_beside *change) {
  int64_t left = 0, right = 0;
  for (int c = 0; c < 4; c++)
    if (bits_of(way(change, 0, c)) > bits_of(left)) {
      left = way(change, 0, c);
      right = way(change, 1, c);
    }
  if (left < 0) {
    left = -left;
    right = -right;
  }
  if (left == 0 || right <= 0)
    return 0;
  return right <= left ? (int32_t)((right * PF_SLOPE + left / 2) / left)
                       : -(int32_t)((left * PF_SLOPE + right / 2) / right);
}

/* The bits by which a guess of a change is nearer than the cell before. */
static int find_gain(const pf_beside *change, int32_t slope) {
  pf_beside trial = *change;
  planefile_cell guess;
  int side = slope > 0, gain = 0;
  trial.slope = slope;
  if (!pf_guess(&trial, change->after[side], &guess))
    return 0;
  for (int c = 0; c < 4; c++)
    gain += bits_of(way(change, side, c)) -
            bits_of((int64_t)change->after[side]->colour[c] - guess.colour[c]);
  return gain > 0 ? gain : 0;
}

static int find_gains(const pf_beside *changes, size_t count, int32_t slope) {
  int gains = 0;
  for (size_t i = 0; i < count && i < TRIALS; i++)
    if (is_known(&changes[i]))
      gains += find_gain(&changes[i], slope);
  return gains;
}

int32_t pf_slope_find(const pf_beside *changes, size_t count) {
  int32_t best = 0;
  int most = LEAST, proposed = 0;
  for (size_t i = 0; i < count && proposed < PROPOSALS; i++) {
    int32_t slope = is_known(&changes[i]) ? propose(&changes[i]) : 0;
    if (slope == 0)
      continue;
    proposed++;
    int gains = find_gains(changes, count, slope);
    if (gains > most) {
      most = gains;
      best = slope;
    }
  }
  return best;
}
