#include "in_process.h"

#include <caml/alloc.h>
#include <caml/callback.h>
#include <caml/memory.h>
#include <caml/mlvalues.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

void gene_clocks_oracle_start(void) {
    char* arguments[] = {(char*)"oracle", NULL};
    caml_startup_pooled(arguments); /* a pool, so that leak checkers see what refers to it */
    /* To the stack for signals only the kernel refers: leak checkers must see that as well. */
    static stack_t signal_stack;
    if (sigaltstack(NULL, &signal_stack) != 0) abort();
}

static const char* call(const char* name, const char* bytes, size_t size) {
    static char* answer; /* the garbage collector moves OCaml's strings */
    CAMLparam0();
    CAMLlocal1(text);
    text = caml_callback(*caml_named_value(name), caml_alloc_initialized_string(size, bytes));
    free(answer);
    answer = strdup(String_val(text));
    if (answer == NULL) abort();
    CAMLreturnT(const char*, answer);
}

const char* gene_clocks_oracle_answer(const char* line) {
    return call("gene_clocks_oracle_answer", line, strlen(line));
}

const char* gene_clocks_oracle_verdict(const char* trace, size_t size) {
    return call("gene_clocks_oracle_verdict", trace, size);
}
