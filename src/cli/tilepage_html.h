/* src/cli/tiles.html, ended by a zero: the page with a mark where its data goes. */
#ifndef CS_CLI_TILEPAGE_HTML_H
#define CS_CLI_TILEPAGE_HTML_H

extern const unsigned char cs_tilepage_html[];

#endif
