//! Closed sets: each lists its members once, and whoever asks for all of them, or for their names, asks the type.

/// An enum of plain members that knows them all.
///
/// With a key for each member it is one that scenes and files name: the key is what serde writes and reads, `KEYS` what a
/// scene may say, and `name` what people read, which is the key unless another word follows it.
///
/// ```
/// asperity_engine::closed_set! {
///     /// How the film ruptures.
///     pub enum Rupture {
///         /// The gap behind the contact counts as full.
///         Reynolds = "reynolds",
///         /// Mass-conserving.
///         Jfo = "jfo" "Jakobsson-Floberg-Olsson",
///     }
/// }
/// assert_eq!(Rupture::KEYS, ["reynolds", "jfo"]);
/// assert_eq!(Rupture::from_key("jfo"), Some(Rupture::Jfo));
/// assert_eq!(Rupture::ALL.map(Rupture::name), ["reynolds", "Jakobsson-Floberg-Olsson"]);
/// ```
#[macro_export]
macro_rules! closed_set {
    (
        $(#[$meta:meta])*
        $vis:vis enum $Set:ident {
            $($(#[$doc:meta])* $Member:ident = $key:literal $($name:literal)?),+ $(,)?
        }
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, ::serde::Serialize, ::serde::Deserialize)]
        $vis enum $Set {
            $($(#[$doc])* #[serde(rename = $key)] $Member),+
        }

        impl $Set {
            /// The keys of all members, in their order.
            $vis const KEYS: &'static [&'static str] = &[$($key),+];
            /// All members.
            $vis const ALL: [Self; Self::KEYS.len()] = [$(Self::$Member),+];

            /// Its name in scenes and files.
            $vis const fn key(self) -> &'static str {
                Self::KEYS[self as usize]
            }

            /// Its name for people.
            #[allow(dead_code, reason = "not every set is shown to people")]
            $vis const fn name(self) -> &'static str {
                match self {
                    $(Self::$Member => [$($name,)? $key][0]),+
                }
            }

            /// The member of that key.
            #[allow(dead_code, reason = "most are read by serde")]
            $vis fn from_key(key: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|member| member.key() == key)
            }
        }
    };
    (
        $(#[$meta:meta])*
        $vis:vis enum $Set:ident {
            $($(#[$doc:meta])* $Member:ident),+ $(,)?
        }
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        $vis enum $Set {
            $($(#[$doc])* $Member),+
        }

        impl $Set {
            /// All members.
            $vis const ALL: [Self; [$(stringify!($Member)),+].len()] = [$(Self::$Member),+];
        }
    };
}
