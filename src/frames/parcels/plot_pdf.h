/* The plotter of PDF, which a module has; it puts bytes into the file of a text. */
#pragma once

#include "frames/parcels/plot_text.h"
#include "frames/parcels/plotter.h"

/* Errors: OUTPUT if there is no module, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_plot_pdf_open(cs_plot_text *text, cs_plotter *out);
