// The end of an MCAP file: what makes it quick to look into. Not real time; no heap.
#pragma once

#include "firmware/telemetry/outputs/file_sink.h"

namespace tactus::firmware {

// Closes the data section of a file that ends with a whole record, and adds copies of its schemas
// and channels, the indexes of chunks, attachments and metadata, statistics, offsets and footer.
// They are gathered by reading the file, so that a long run needs no more memory than a short one.
// Errors are the sink's; a file that does not read back loses its summary.
void write_mcap_summary(FileSink& sink);

}  // namespace tactus::firmware
