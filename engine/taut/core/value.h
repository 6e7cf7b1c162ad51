// Special members of large values, compiled once. Otherwise every file that copies or destroys a struct of maps, texts
// and lists compiles them again, with their parts of the standard library: a quarter of all functions.
#pragma once

// In the struct. It is no aggregate then.
#define TAUT_VALUE(Type)          \
    Type();                       \
    ~Type();                      \
    Type(const Type&);            \
    Type(Type&&) noexcept;        \
    Type& operator=(const Type&); \
    Type& operator=(Type&&) noexcept

// In one .cpp.
#define TAUT_VALUE_MEMBERS(Type) \
    Type::Type() = default;      \
    TAUT_VALUE_COPIES(Type)

// The same for a struct that defines its default constructor itself.
#define TAUT_VALUE_COPIES(Type)                   \
    Type::~Type() = default;                      \
    Type::Type(const Type&) = default;            \
    Type::Type(Type&&) noexcept = default;        \
    Type& Type::operator=(const Type&) = default; \
    Type& Type::operator=(Type&&) noexcept = default

// The same for a base with virtual functions, which declares them itself: a destructor, and copies for its kinds.
#define TAUT_BASE_MEMBERS(Type)                   \
    Type::Type() = default;                       \
    Type::Type(const Type&) = default;            \
    Type& Type::operator=(const Type&) = default; \
    Type::~Type() = default
