// Judges what the data of a record tell about each quantity of a fit. fit.cpp calls it.
#pragma once

#include <optional>
#include <string>

#include "host_tools/friction/fit_record.h"
#include "host_tools/friction/fit_search.h"

namespace tactus::host {

// Returns the standard error of a quantity's logarithm; 0 if it was not searched.
double error_of(const Solution& solution, Quantity quantity);

// Returns the relative error of static friction, which is the sum of two quantities.
double static_error(const Solution& solution);

// Returns true if a quantity with this standard error of its logarithm cannot be told from the
// data.
bool is_unknown(double error);

// Returns the quantity that the data tell least about, if they do not tell enough. The fall with
// speed is judged as a whole before its parts.
std::optional<Quantity> least_known(const Solution& solution);

// Returns true if the record has enough rows of presliding for its reversals.
bool shows_presliding(const RecordTraits& traits);

// Returns why the data do not tell a quantity, for the user.
std::string why_unknown(Quantity quantity, const Solution& solution, const FrictionRecord& record,
                        const RecordTraits& traits);

}  // namespace tactus::host
