#!/usr/bin/env bash
# Fails, naming each library, object and symbol, when static libraries refer to the heap, exceptions or stdio.
#   toolchains/check_no_heap.sh NM LIBRARY...
set -euo pipefail

if [[ $# -lt 2 ]]; then
  echo "usage: ${BASH_SOURCE[0]} NM LIBRARY..." >&2
  exit 2
fi
nm="$1"
shift

# Mangled names: _Znw _Zna _Zdl _Zda are operator new, new[], delete and delete[]; _ZSt<n>__throw_ std::__throw_...
forbidden=(
  '_*(malloc|calloc|realloc|reallocarray|free|memalign|aligned_alloc|posix_memalign|strn?dup|sbrk)(_r)?'
  '_Z(nw|na|dl|da).*'
  '__cxa_(throw|rethrow|allocate_|free_|begin_catch|end_catch|bad_|call_unexpected|get_exception).*'
  '_ZSt[0-9]+__throw_.*|_Unwind_.*|__aeabi_unwind_.*|__gxx_personality.*'
  '_?v?(as|asn|d|f|fw|s|sn|sw|w)?i?(printf|scanf)(_r)?'
  '_?(f|w|fw)?(puts|putc|putchar|gets|getc|getchar|open|close|read|write|flush|seek|tell)(_r|_unlocked)?'
  'perror|setv?buf|_impure_ptr|_ZNSo.*|_ZNSi.*|_ZSt4(cout|cerr|clog)|_ZNSt8ios_base.*|_ZSt16__ostream_insert.*'
  '__assert.*'                                 # prints through stdio
  'atexit|__cxa_atexit|__aeabi_atexit'         # a static with a destructor: newlib's list of them grows on the heap
)
pattern="^($(IFS='|' && echo "${forbidden[*]}"))$"

references="$("$nm" --print-file-name --undefined-only "$@")"
offences="$(awk -v pattern="$pattern" '$NF ~ pattern { print $1, $NF }' <<<"$references")"
if [[ -n "$offences" ]]; then
  while read -r object symbol; do
    echo "check_no_heap: ${object%:} refers to $symbol ($(c++filt "$symbol"))" >&2
  done <<<"$offences"
  exit 1
fi
echo "check_no_heap: $# libraries refer to no heap, exception or stdio symbol"
