#include "in_process.h"

#include <caml/alloc.h>
#include <caml/callback.h>
#include <caml/memory.h>
#include <caml/mlvalues.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void gene_clocks_oracle_start(void) {
    char* arguments[] = {(char*)"oracle", NULL};
    caml_startup_pooled(arguments); /* a pool, so that leak checkers see what refers to it */
}

const char* gene_clocks_oracle_answer(const char* line) {
    static char* answer; /* the garbage collector moves OCaml's strings */
    CAMLparam0();
    CAMLlocal1(text);
    const value* const function = caml_named_value("gene_clocks_oracle_answer");
    text = caml_callback(*function, caml_copy_string(line));
    free(answer);
    answer = strdup(String_val(text));
    if (answer == NULL) abort();
    CAMLreturnT(const char*, answer);
}
