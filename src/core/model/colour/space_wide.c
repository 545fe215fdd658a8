/* The curve of sRGB over many channels, in loops of a few steps each, which become vector code. A
 * power is computed also for channels on the straight part of the curve: that of the end of the
 * straight part.
 *
 *   s, share --> colour --> base --> power of it --> colour, converted --> s
 *
 * A colour that the tables of powers do not reach, far beyond 1 or not a number, is rare: then the
 * channels that are converted together with it are converted one by one.
 */
#include "model/colour/power.h"
#include "model/colour/space.h"

#define TOGETHER 32
#define PIXELS 64 /* side by side: no channels are left over where none is clear */
#define ALONE 8   /* channels at most: they are converted in less time one by one */

typedef struct channels {
  float s[TOGETHER], there[TOGETHER], colours[TOGETHER]; /* as in space.h */
  double sizes[TOGETHER];                                /* the magnitudes of the colours */
  double bases[TOGETHER];
  int32_t octaves[TOGETHER], slices[TOGETHER]; /* as in power.h */
  double rests[TOGETHER], powers[TOGETHER];
} channels;

/* At first `there` holds the shares. */
static inline void find_colours(channels *all) {
  for (int i = 0; i < TOGETHER; i++) {
    float there = cs_space_there(all->s[i], all->there[i]);
    all->there[i] = there;
    all->colours[i] = all->s[i] / (there > 0 ? there : 1);
  }
}

/* False if some colour is outside of the tables. */
static inline bool find_sizes(channels *all) {
  int32_t beyond = 0;
  for (int i = 0; i < TOGETHER; i++) {
    all->sizes[i] = fabs((double)all->colours[i]);
    beyond += !(all->sizes[i] < CS_POWER_END / 2);
  }
  return beyond == 0;
}

/* The tables are read in a separate loop, so that the other two loops become vector code. */
static inline void find_powers(const cs_power *power, channels *all) {
  for (int i = 0; i < TOGETHER; i++) {
    const cs_power_parts parts = cs_power_split(all->bases[i]);
    all->octaves[i] = parts.octave;
    all->slices[i] = parts.slice;
    all->rests[i] = parts.r;
  }
  for (int i = 0; i < TOGETHER; i++)
    all->powers[i] = cs_power_scale(power, all->octaves[i], all->slices[i]);
  for (int i = 0; i < TOGETHER; i++)
    all->powers[i] = cs_power_join(power, all->powers[i], all->rests[i]);
}

static inline void encode(channels *all) {
  for (int i = 0; i < TOGETHER; i++)
    all->bases[i] = all->sizes[i] > CS_POWER_SRGB_LIGHT ? all->sizes[i] : CS_POWER_SRGB_LIGHT;
  find_powers(&cs_power_srgb_encoding, all);
  for (int i = 0; i < TOGETHER; i++)
    all->sizes[i] = cs_power_srgb_encoded(all->sizes[i], all->powers[i]);
}

static inline void decode(channels *all) {
  for (int i = 0; i < TOGETHER; i++)
    all->bases[i] = cs_power_srgb_base(all->sizes[i]);
  find_powers(&cs_power_srgb_decoding, all);
  for (int i = 0; i < TOGETHER; i++)
    all->sizes[i] = cs_power_srgb_decoded(all->sizes[i], all->powers[i]);
}

static inline void join(channels *all) {
  for (int i = 0; i < TOGETHER; i++) {
    float colour = copysignf((float)all->sizes[i], all->colours[i]);
    all->s[i] = all->there[i] > 0 ? all->there[i] * colour : all->s[i];
  }
}

static void convert_alone(celspan_space to, const float *shares, int32_t count, float *s) {
  for (int32_t i = 0; i < count; i++)
    s[i] = cs_space_channel(to, s[i], shares[i]);
}

static void convert(celspan_space to, const float *shares, int32_t count, float *s) {
  channels all = {.s = {0}};
  for (; count > 0; count -= TOGETHER, shares += TOGETHER, s += TOGETHER) {
    int32_t some = count < TOGETHER ? count : TOGETHER;
    memcpy(all.s, s, (size_t)some * sizeof *s);
    memcpy(all.there, shares, (size_t)some * sizeof *shares);
    find_colours(&all);
    if (!find_sizes(&all)) {
      convert_alone(to, shares, some, s);
      continue;
    }
    if (to == CELSPAN_SPACE_SRGB)
      encode(&all);
    else
      decode(&all);
    join(&all);
    memcpy(s, all.s, (size_t)some * sizeof *s);
  }
}

void CS_WIDE(cs_space_channels)(celspan_space to, const float *shares, int32_t count, float *s) {
  (count <= ALONE ? convert_alone : convert)(to, shares, count, s);
}

/* Pixels side by side without their alphas; black ones, which stay black, are left out. Each is
 * written with one lane more than it has colours: the next one, or nobody, has the place.
 *
 *   s  rgb- 0000 rgb- --pack--> rgbrgb --convert--> rgb- 0000 rgb-
 */
typedef struct packed {
  float s[3 * PIXELS + 1], shares[3 * PIXELS + 1];
  int32_t from[PIXELS]; /* their places in the row */
} packed;

static inline bool is_black(cs_v4 s) {
  typedef int64_t words __attribute__((vector_size(16)));
  const words lanes = (words)(s != 0);
  return (lanes[0] | lanes[1]) == 0;
}

static inline int32_t pack(const float *shares, int32_t count, const float *s, packed *out) {
  int32_t size = 0;
  for (int32_t k = 0; k < count; k++) {
    const cs_v4 colour = cs_v4_load(s + 4 * k);
    cs_v4_store(out->s + 3 * size, colour);
    cs_v4_store(out->shares + 3 * size, cs_v4_load(shares + 4 * k));
    out->from[size] = k;
    size += !is_black(colour);
  }
  return size;
}

void CS_WIDE(cs_space_pixels)(celspan_space to, const float *shares, int32_t count, float *s) {
  packed work;
  for (; count > 0; count -= PIXELS, shares += 4 * PIXELS, s += 4 * PIXELS) {
    int32_t size = pack(shares, count < PIXELS ? count : PIXELS, s, &work);
    CS_WIDE(cs_space_channels)(to, work.shares, 3 * size, work.s);
    for (int32_t i = 0; i < size; i++)
      memcpy(s + 4 * work.from[i], work.s + 3 * i, 3 * sizeof(float));
  }
}

void CS_WIDE(cs_space_codes)(int32_t count, float *colours) {
  channels all = {.colours = {0}};
  for (; count > 0; count -= TOGETHER, colours += TOGETHER) {
    int32_t some = count < TOGETHER ? count : TOGETHER;
    memcpy(all.colours, colours, (size_t)some * sizeof *colours);
    if (!find_sizes(&all)) {
      for (int32_t i = 0; i < some; i++)
        colours[i] = cs_space_channel(CELSPAN_SPACE_SRGB, colours[i], 1);
      continue;
    }
    encode(&all);
    for (int i = 0; i < TOGETHER; i++)
      all.colours[i] = copysignf((float)all.sizes[i], all.colours[i]);
    memcpy(colours, all.colours, (size_t)some * sizeof *colours);
  }
}
