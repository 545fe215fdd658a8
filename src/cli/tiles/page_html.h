/* page.html, ended by a zero: the page, with a mark where its data goes. */
#ifndef CS_CLI_TILES_PAGE_HTML_H
#define CS_CLI_TILES_PAGE_HTML_H

extern const unsigned char cs_tile_page_html[];

#endif
