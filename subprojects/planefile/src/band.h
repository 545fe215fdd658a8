/* The code of a band: what is coded in which order, by which models.
 *
 *   cell 0 | chains: start, number of pieces, cells at the top, pieces | changes, in groups
 *
 *           |  chain 4: a | b
 *         --+-- height          a group: at one height, several chains get other cells on their
 *        |     |                sides, or are hidden from there on: left and right are one cell
 *     a|d       d|b
 *
 * A chain begins with the cells at its top, or at the band's, and ends at its foot. So only what
 * happens in between has a height of its own. Most changes are crossings of two chains, whose new
 * cells are those of before in other places, and one new cell between them: a cell is one of six
 * candidates, or new, or else an older one.
 *
 * A band of a film may be made from a base, which is the band at the same heights of another frame:
 *
 *   what changes of the base's axes and cells | chains: new as above, or one of the base's, moved,
 *   with its borders or with others | changes
 *
 * The cells of the base are there from the beginning, and the models are as its code has left them.
 *
 * INVARIANT: encoder and decoder make their candidates by the same functions.
 */
#pragma once

#include "codes.h"
#include "program.h"
#include "slope.h"

enum { PF_FRESH, PF_OLDER, PF_CANDIDATES, PF_SYMBOLS = 8, PF_SYMBOL_BITS = 3 };
/* Forms of pieces: the degree, and this where they are rational. */
enum { PF_RATIONAL = 4 };
/* The moves of chains: the latest ones that differ, and a symbol for another one. */
enum { PF_MOVE_BITS = 3, PF_MOVE_SYMBOLS = 1 << PF_MOVE_BITS, PF_MOVES = PF_MOVE_SYMBOLS - 1 };

typedef struct pf_models {
  pf_number start[2], pieces, moves[2][3][3], weight; /* moves: axis, degree, point */
  pf_number from_top, to_foot;                        /* of which chain before, or 0 */
  pf_number ahead, aside;                             /* of smooth joints */
  uint16_t is_smooth[2];
  pf_number channels[2][4], slope; /* channels: of cells that are not guessed, and that are */
  pf_number older, height, size, first, next;
  uint16_t guesses[4];
  uint16_t forms[8][8];           /* after each */
  uint16_t cells[14][PF_SYMBOLS]; /* pf_context */
  /* of bands that are made from a base */
  uint16_t origin[4], moved[PF_MOVE_SYMBOLS], is_patched[2], fates[4];
  pf_number which, shift[2], bent[2], changed[4]; /* changed: channels of its cells */
} pf_models;

/* All that the code of a band has learned. */
typedef struct pf_learned {
  pf_models models;
  pf_program_models programs;
} pf_learned;

/* A move from a point to the next one: x, y. */
typedef struct pf_way {
  int64_t by[2];
} pf_way;

static inline int64_t pf_size(int64_t move) { return move < 0 ? -move : move; }
/* Whether a piece after this move may begin smoothly. */
static inline bool pf_leads_on(const pf_way *way) { return way->by[0] != 0 || way->by[1] != 0; }
/* The axis along which a way is longer, x if neither is. */
static inline int pf_main_axis(const pf_way *way) {
  return pf_size(way->by[1]) > pf_size(way->by[0]);
}
/* The move on the other axis where a way with this main axis continues for `along` units of it,
 * forwards. */
static inline int64_t pf_go_on(const pf_way *way, int axis, int64_t along) {
  int64_t length = pf_size(way->by[axis]);
  return pf_divide(2 * along * way->by[!axis] + length, 2 * length);
}
/* -1 or 1: what turns numbers into the direction of a move. */
static inline int pf_direction(int64_t move) { return move < 0 ? -1 : 1; }

/* The cells beside a chain; one twice: it is hidden. */
typedef struct pf_sides {
  uint32_t left, right;
} pf_sides;

/* What the candidates for the sides of a chain are made from. */
typedef struct pf_near {
  pf_sides own;    /* what it had before */
  pf_sides other;  /* what another one had before */
  pf_sides latest; /* what the one before it has got */
} pf_near;

/* left: of the chain, already known where is_right. */
static inline uint32_t pf_candidate(const pf_near *near, bool is_right, uint32_t left,
                                    uint32_t symbol) {
  const uint32_t candidates[PF_SYMBOLS] = {0,
                                           0,
                                           is_right ? left : near->own.left,
                                           near->own.right,
                                           near->other.left,
                                           near->other.right,
                                           near->latest.left,
                                           near->latest.right};
  return candidates[symbol];
}

/* Of chains at their tops. */
#define PF_AT_TOP 0
/* Of member `index` of a group of `size`; right: the next one. */
static inline unsigned pf_context(uint32_t size, uint32_t index) {
  uint32_t kind = size < 3 ? size - 1 : 2;
  return 2 + 4 * kind + 2 * (index > 0);
}

/* The chain whose old cells are candidates for member `index` of a group. */
static inline uint32_t pf_other(uint32_t size, uint32_t index) {
  return index > 0 ? index - 1 : size > 1 ? 1 : 0;
}

/* The borders of a chain, which follow each other downwards. The chain has no point beside low and
 * high. */
typedef struct pf_run {
  int32_t top, foot; /* of the first one; of the last one */
  int32_t low, high;
  uint32_t border; /* the first one */
} pf_run;

/* A band as it was read, all of it owned. */
typedef struct pf_band {
  planefile_band band;
  pf_run *runs; /* by their tops */
  uint32_t run_count;
  size_t run_capacity;
  size_t point_capacity, piece_capacity, chain_capacity, border_capacity, cell_capacity;
  size_t program_capacity, step_capacity, axis_capacity, stop_capacity;
} pf_band;

/* ---------------------------------------------------------------- bases */

/* Where a chain of a band with a base comes from. */
enum {
  PF_NEW,
  PF_MOVED,
  PF_KEPT, /* moved, with its borders */
  PF_BENT, /* as many pieces of the same forms */
  PF_ORIGIN_BITS = 2
};

/* In steps of the grid. */
typedef struct pf_move {
  int32_t x, y;
} pf_move;

/* The moves that chains had, the latest one first; all are 0, 0 at first. */
typedef struct pf_moves {
  pf_move latest[PF_MOVES];
} pf_moves;

/* Puts the one with a number, or, with PF_MOVES, another one first. */
static inline void pf_moves_use(pf_moves *moves, uint32_t number, pf_move move) {
  for (uint32_t i = number < PF_MOVES ? number : PF_MOVES - 1; i > 0; i--)
    moves->latest[i] = moves->latest[i - 1];
  moves->latest[0] = move;
}

/* What becomes of a cell of the base: nothing; other colours, or steps of other colours; or it is
 * another one. */
typedef enum pf_fate { PF_SAME, PF_RECOLOURED, PF_REPLACED, PF_FATE_BITS = 2 } pf_fate;

/* A band that others are made from. */
typedef struct pf_base {
  pf_memory memory;
  const planefile_band *band;
  size_t code;         /* bytes */
  pf_learned *learned; /* by the code */
  uint32_t *first;     /* of each chain: its first border; and the end */
} pf_base;

/* An empty base, whose `learned` can be filled by pf_band_decode. Like one that was completed, it
 * must be freed whatever happens. False: no memory. */
bool pf_base_begin(const pf_memory *memory, pf_base *out);
/* band: what was decoded, borrowed. False: no memory. */
bool pf_base_complete(const planefile_band *band, size_t code, pf_base *base);
void pf_base_free(pf_base *base);
/* The models with which a band begins. base: NULL: none; programs: NULL: nothing varies. */
void pf_base_learned(const pf_base *base, pf_models *models, pf_program_models *programs);
/* The cells of a chain at its first border. */
static inline pf_sides pf_base_sides(const pf_base *base, uint32_t chain) {
  if (base->first[chain] == base->first[chain + 1])
    return (pf_sides){0, 0};
  const planefile_border *border = &base->band->borders[base->first[chain]];
  return (pf_sides){border->left, border->right};
}
/* A height that has been moved by some steps; limited to the frame. */
static inline int32_t pf_move_height(int32_t height, int32_t by, uint16_t rows) {
  int64_t to = planefile_place_of(planefile_step_at(height, rows) + by, rows);
  return (int32_t)(to < 0 ? 0 : to > PLANEFILE_SIDE ? PLANEFILE_SIDE : to);
}
/* The part of a border that is at the heights of a band when it has been moved; false: none is. */
static inline bool pf_move_border(const planefile_border *border, int32_t by, uint16_t rows,
                                  const planefile_band *band, planefile_border *out) {
  int32_t top = pf_move_height(border->top, by, rows),
          foot = pf_move_height(border->foot, by, rows);
  *out = *border;
  out->top = top > band->top ? top : band->top;
  out->foot = foot < band->foot ? foot : band->foot;
  return out->top < out->foot;
}

/* Whether the sums of borders remain exact (sums.h): what they change, in each channel, is together
 * less than 2^36. */
static inline bool pf_is_moderate(const planefile_cell *cells, const planefile_border *borders,
                                  size_t count) {
  int64_t sums[4] = {0};
  for (size_t i = 0; i < count; i++)
    for (int c = 0; c < 4; c++) {
      int64_t way = (int64_t)cells[borders[i].right].colour[c] - cells[borders[i].left].colour[c];
      sums[c] += way < 0 ? -way : way;
    }
  return (sums[0] | sums[1] | sums[2] | sums[3]) >> 36 == 0;
}

/* Whether alpha is 1 in all cells. */
static inline bool pf_band_is_opaque(const planefile_band *band) {
  bool is_opaque = true;
  for (uint32_t i = 0; is_opaque && i < band->cell_count; i++)
    is_opaque = band->programs && band->programs[i].step_count > 0
                    ? pf_program_hides(band, band->programs[i], false)
                    : band->cells[i].colour[3] == PLANEFILE_WHITE;
  return is_opaque;
}

/* Of a payload, before the code. */
static inline size_t pf_band_head(bool varies) {
  return PF_BAND_BYTES + (varies ? PF_VARIED_BYTES : 0);
}

/* The payload of a record of a band. */
typedef struct pf_payload {
  const unsigned char *bytes;
  size_t size;
  bool varies;
  const pf_codes *codes;  /* NULL: cells are not codes */
  uint32_t picture_count; /* of the file */
  const pf_base *base;    /* NULL: it has none */
  planefile_grid grid;
  pf_learned *learned; /* where what it teaches goes; NULL: nowhere */
} pf_payload;
/* Decodes a band. out: empty; must be freed whatever happens. reason: set where the status is not
 * OK. */
planefile_status pf_band_decode(const pf_memory *memory, const pf_payload *payload, pf_band *out,
                                const char **reason);
void pf_band_free(const pf_memory *memory, pf_band *band);
/* Finds the runs of a band whose borders are by their chains. False: no memory. */
bool pf_band_make_runs(const pf_memory *memory, pf_band *out);

/* Whether a plane that somebody wants to write has all that it refers to, on the grid, as readers
 * accept it. */
bool pf_plane_is_good(const planefile_band *plane, planefile_grid grid);

/* -1, 0 or 1, for qsort: of numbers; of borders by their chains, then by their tops. */
static inline int pf_order(int64_t a, int64_t b) { return (a > b) - (a < b); }
int pf_border_compare(const void *first, const void *second);

/* A part of a plane: what lies in the heights [top, foot). */
typedef struct pf_part {
  const planefile_band *plane;
  const planefile_border *borders; /* all that have a part there; no two of one chain overlap */
  size_t count;
  int32_t top, foot;
  bool is_whole;         /* pieces of which nothing can be seen are kept, for other frames */
  const pf_base *base;   /* NULL: none */
  const pf_codes *codes; /* NULL: cells are not codes; otherwise all flat ones are rounded */
  planefile_grid grid;
} pf_part;
/* The payload is in the encoder's bytes. */
planefile_status pf_band_encode(const pf_memory *memory, const pf_part *part, pf_encoder *out);
