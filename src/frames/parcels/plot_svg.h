/* The plotter of SVG, over the text of a file. */
#pragma once

#include "frames/parcels/plot_text.h"
#include "frames/parcels/plotter.h"

void cs_plot_svg_open(cs_plot_text *text, cs_plotter *out);
