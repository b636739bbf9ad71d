//! What a saved state holds, checked once and taken over into the memory that is there.
//!
//! A state comes from a file, and a file may come from anywhere. The state that the scene makes is the measure: a saved one
//! must have the same settings and lengths, so that no size is taken from the file, and values that a run can bring. It
//! is copied into the buffers of the other only when all of it holds. Numbers are finite already: the format of the
//! file has no others.

/// Part of a state; [`saved!`] implements it from one list of the fields.
pub(crate) trait Saved {
    /// Whether `saved` can be taken over.
    ///
    /// # Errors
    /// Path of the first field that cannot.
    fn check(&self, saved: &Self) -> Result<(), String>;

    /// Takes over what [`Saved::check`] has passed; the memory that is there stays.
    fn restore(&mut self, saved: &Self);
}

/// How [`Saved`] treats each field of a type:
///
/// ```text
/// same   settings, equal in both
/// parts  each checked and restored as [`Saved`]: lists keep their length
/// room   lists that grow up to the memory that `new` has made
/// free   any value
/// holds  what must be true of the saved one
/// ```
macro_rules! saved {
    (
        $type:ident {
            $(same: $($same:ident),+;)?
            $(parts: $($part:ident),+;)?
            $(room: $($room:ident),+;)?
            $(free: $($free:ident),+;)?
        }
        $(holds |$own:pat_param, $saved:ident| $holds:expr)?
    ) => {
        impl $crate::saved::Saved for $type {
            fn check(&self, saved: &Self) -> Result<(), String> {
                let Self {
                    $($($same: _,)+)? $($($part: _,)+)? $($($room: _,)+)? $($($free: _,)+)?
                } = saved;
                $($(
                    if self.$same != saved.$same {
                        return Err(stringify!($same).to_owned());
                    }
                )+)?
                $($(
                    if let Err(inner) = $crate::saved::Saved::check(&self.$part, &saved.$part) {
                        return Err($crate::saved::path(stringify!($part), &inner));
                    }
                )+)?
                $($(
                    if saved.$room.len() > self.$room.capacity() {
                        return Err(stringify!($room).to_owned());
                    }
                )+)?
                $(
                    let ($own, $saved) = (self, saved);
                    let holds: bool = $holds;
                    if !holds {
                        return Err(String::new());
                    }
                )?
                Ok(())
            }

            fn restore(&mut self, saved: &Self) {
                $($($crate::saved::Saved::restore(&mut self.$part, &saved.$part);)+)?
                $($(self.$room.clone_from(&saved.$room);)+)?
                $($(self.$free.clone_from(&saved.$free);)+)?
            }
        }
    };
}
pub(crate) use saved;

/// A field's name before what lies in it.
pub(crate) fn path(field: &str, inner: &str) -> String {
    if inner.is_empty() {
        field.to_owned()
    } else {
        format!("{field}.{inner}")
    }
}

/// Types of which any value will do.
macro_rules! any {
    ($($type:ty),+) => {$(
        impl $crate::saved::Saved for $type {
            fn check(&self, _: &Self) -> Result<(), String> {
                Ok(())
            }

            fn restore(&mut self, saved: &Self) {
                *self = *saved;
            }
        }
    )+};
}
pub(crate) use any;

any!(f32, f64, u32);

impl<T: Saved> Saved for [T] {
    fn check(&self, saved: &Self) -> Result<(), String> {
        if self.len() != saved.len() {
            return Err(String::new());
        }
        let mut pairs = self.iter().zip(saved);
        pairs.try_for_each(|(own, saved)| own.check(saved))
    }

    fn restore(&mut self, saved: &Self) {
        for (own, saved) in self.iter_mut().zip(saved) {
            own.restore(saved);
        }
    }
}

impl<T: Saved, const N: usize> Saved for [T; N] {
    fn check(&self, saved: &Self) -> Result<(), String> {
        self[..].check(&saved[..])
    }

    fn restore(&mut self, saved: &Self) {
        self[..].restore(&saved[..]);
    }
}

impl<T: Saved> Saved for Vec<T> {
    fn check(&self, saved: &Self) -> Result<(), String> {
        self[..].check(&saved[..])
    }

    fn restore(&mut self, saved: &Self) {
        self[..].restore(&saved[..]);
    }
}

/// What a scene has or has not.
impl<T: Saved> Saved for Option<T> {
    fn check(&self, saved: &Self) -> Result<(), String> {
        match (self, saved) {
            (Some(own), Some(saved)) => own.check(saved),
            (None, None) => Ok(()),
            (Some(_), None) | (None, Some(_)) => Err(String::new()),
        }
    }

    fn restore(&mut self, saved: &Self) {
        if let (Some(own), Some(saved)) = (self, saved) {
            own.restore(saved);
        }
    }
}
