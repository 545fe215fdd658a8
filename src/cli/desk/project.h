/* What `celspan init` lays out: the files of project/, each ended by a zero. */
#ifndef CS_CLI_DESK_PROJECT_H
#define CS_CLI_DESK_PROJECT_H

extern const unsigned char cs_project_film[];
extern const unsigned char cs_project_sheet[];
extern const unsigned char cs_project_spec[];
extern const unsigned char cs_project_readme[];
extern const unsigned char cs_project_luarc[];
extern const unsigned char cs_project_luacheckrc[];
extern const unsigned char cs_project_busted[];
extern const unsigned char cs_project_gitignore[];

#endif
